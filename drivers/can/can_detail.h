// SPDX-License-Identifier: BSD-3-Clause
// The reason of a CAN driver's fault, as ActuatorReading::drive_error: our number in the highest byte and a
// value below it. The numbers are fixed; docs/can.md lists them. Real-time safe except for the text.
#pragma once

#include <cstdint>
#include <string>

namespace strainwave {

enum class CanDetail : std::uint8_t {
  kNone = 0,
  kInterfaceDown = 1,
  kInterfaceGone = 2,
  kFramesStuck = 3,  ///< frames of one period have not left before the next
  kBusOff = 4,
  kErrorPassive = 5,
  kForeignSender = 6,     ///< value: the identifier that another node uses
  kHeartbeatMissing = 7,  ///< heartbeat of the drive
  kBootUp = 8,
  kNetworkState = 9,  ///< value: the new NMT state of the drive
  kPositionMissing = 10,
  kWrongMode = 11,      ///< value: the mode of operation that the drive reports
  kEnableStep = 12,     ///< value: the statusword at which the drive stopped
  kLeftOperation = 13,  ///< value: the statusword
  kFaultState = 14,     ///< value: the statusword; no emergency message came
  kSetupFailed = 15,    ///< the log gives the reason
  kQueueFull = 16,
  kFlooded = 17,
  kNotFollowing = 18,  ///< value: the statusword
  kPositionLate = 19,  ///< value: microseconds from SYNC to position
};

/// The largest value of a detail.
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

/// Returns the detail in words.
std::string can_detail_text(std::uint32_t drive_error);

}  // namespace strainwave
