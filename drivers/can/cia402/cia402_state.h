// SPDX-License-Identifier: BSD-3-Clause
// The power state machine of a drive as a table: the state that a statusword shows, and the controlword for
// the next step. Pure functions, real-time safe. Source: CiA 402-2 (IEC 61800-7-201), tables 27 to 30.
#pragma once

#include <cstdint>
#include <string_view>

namespace strainwave::cia402 {

enum class PowerState : std::uint8_t {
  kNotReady,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReaction,
  kFault,
};
std::string_view to_text(PowerState state) noexcept;

/// State that the drive shall reach.
enum class Goal : std::uint8_t {
  kDisabled,   ///< no torque, by a normal shutdown
  kEnabled,    ///< torque commands take effect
  kQuickStop,  ///< stopped as fast as the drive can, then without torque
};

/// Values of the controlword (6040h).
namespace controlword {
inline constexpr std::uint16_t kShutdown = 0x06;
inline constexpr std::uint16_t kSwitchOn = 0x07;
inline constexpr std::uint16_t kEnableOperation = 0x0F;
inline constexpr std::uint16_t kDisableVoltage = 0x00;
inline constexpr std::uint16_t kQuickStop = 0x02;
inline constexpr std::uint16_t kFaultReset = 0x80;
inline constexpr std::uint16_t kInterpolate = 0x10;  ///< added to kEnableOperation in IP
}  // namespace controlword

/// Returns the state of a statusword (6041h), for every value.
PowerState power_state_of(std::uint16_t statusword) noexcept;

/// Returns the next controlword (6040h) on the way to `goal`. It never resets a fault, which needs an operator's order.
std::uint16_t controlword_towards(Goal goal, PowerState state) noexcept;

}  // namespace strainwave::cia402
