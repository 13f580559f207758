// SPDX-License-Identifier: BSD-3-Clause
// CANopen's frames except SDO and PDO: identifiers, network management, SYNC, heartbeat, emergency. Pure
// functions with the numbers of the standard, real-time safe. Source: CiA 301 v4.2.0, sections 7.2.6 to 7.2.8
// and 7.3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/can/can_frame.h"

namespace strainwave::canopen {

inline constexpr std::uint8_t kMaxNodeId = 127;

/// Identifiers of the predefined connection set; add the node id where there is one per node.
enum class CobId : std::uint32_t {
  kNmt = 0x000,
  kSync = 0x080,
  kEmergency = 0x080,  ///< + node
  kTpdo1 = 0x180,
  kRpdo1 = 0x200,
  kTpdo2 = 0x280,
  kSdoAnswer = 0x580,   ///< drive to us
  kSdoRequest = 0x600,  ///< us to the drive
  kHeartbeat = 0x700,
};
constexpr std::uint32_t cob_id(CobId base, std::uint8_t node = 0) noexcept {
  return static_cast<std::uint32_t>(base) + node;
}

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// State in a heartbeat.
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F
};
std::string_view to_text(NmtState state) noexcept;

/// `node` 0 means every node.
CanFrame nmt_frame(NmtCommand command, std::uint8_t node) noexcept;
/// SYNC without a counter.
CanFrame sync_frame() noexcept;
CanFrame heartbeat_frame(std::uint8_t node, NmtState state) noexcept;

/// Returns the state in a heartbeat or boot-up message; nothing for a frame of another size or with an
/// unknown state.
std::optional<NmtState> decode_heartbeat(const CanFrame& frame) noexcept;

/// An emergency message. Code 0x0000: the error is gone.
struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;  ///< object 1001h
};
std::optional<Emergency> decode_emergency(const CanFrame& frame) noexcept;

/// Returns the meaning of an emergency code ("bus: heartbeat lost"); for a vendor's code, that of its class.
std::string_view emergency_text(std::uint16_t code) noexcept;

/// An emergency as one number for ActuatorReading::drive_error, and the text of that number.
constexpr std::uint32_t drive_error_of(const Emergency& emergency) noexcept {
  return static_cast<std::uint32_t>(emergency.error_register) << 16U | emergency.code;
}
std::string drive_error_text(std::uint32_t drive_error);

}  // namespace strainwave::canopen
