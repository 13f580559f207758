// SPDX-License-Identifier: BSD-3-Clause
// Why a CAN driver reports a fault, as ActuatorReading::drive_error: a number of ours in the highest byte
// and, below it, what goes with it. Numbers are fixed; docs/can.md lists them. Real-time safe but for the text.
#pragma once

#include <cstdint>
#include <string>

namespace strainwave {

enum class CanDetail : std::uint8_t {
  kNone = 0,
  kInterfaceDown = 1,
  kInterfaceGone = 2,
  kFramesStuck = 3,  ///< what was sent one period does not leave before the next
  kBusOff = 4,
  kErrorPassive = 5,
  kForeignSender = 6,     ///< below: the identifier that another node uses
  kHeartbeatMissing = 7,  ///< of the drive
  kBootUp = 8,
  kNetworkState = 9,  ///< below: the NMT state that the drive fell into
  kPositionMissing = 10,
  kWrongMode = 11,      ///< below: the mode of operation that the drive shows
  kEnableStep = 12,     ///< below: the statusword in which the drive stayed
  kLeftOperation = 13,  ///< below: the statusword
  kFaultState = 14,     ///< below: the statusword; no emergency message came
  kSetupFailed = 15,    ///< the log says why
  kQueueFull = 16,
  kFlooded = 17,
  kNotFollowing = 18,  ///< below: the statusword
  kPositionLate = 19,  ///< below: microseconds from SYNC to position
};

/// The largest number that can go with a detail.
inline constexpr std::uint32_t kMaxCanDetailValue = 0xFFFF;

constexpr std::uint32_t drive_error_of(CanDetail detail, std::uint32_t value = 0) noexcept {
  return static_cast<std::uint32_t>(detail) << 24U | (value & kMaxCanDetailValue);
}
constexpr CanDetail detail_of(std::uint32_t drive_error) noexcept {
  return static_cast<CanDetail>(drive_error >> 24U);
}
constexpr std::uint32_t detail_value_of(std::uint32_t drive_error) noexcept {
  return drive_error & kMaxCanDetailValue;
}

/// The detail in words.
std::string can_detail_text(std::uint32_t drive_error);

}  // namespace strainwave
