// SPDX-License-Identifier: BSD-3-Clause
// Faults that can be injected into a simulated drive to test the reaction of the loop. Plain data, real-time
// safe. The numbers are fixed because inject_v1.kind carries them. docs/faults.md gives the reaction to each.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace strainwave {

enum class InjectedFault : std::int32_t {
  kNone = 0,                 ///< ends every injected fault
  kSensorStuck = 1,          ///< the position no longer changes
  kSensorNan = 2,            ///< the position is not a number
  kSensorNoisy = 3,          ///< amount: standard deviation in rad
  kSensorDelayed = 4,        ///< amount: delay in s, up to kMaxSensorDelayPeriods
  kSensorJump = 5,           ///< amount: offset in rad
  kTemperatureLost = 6,      ///< no temperature at all
  kTemperatureStuck = 7,     ///< always the same value, as if it were new
  kTemperatureDrifting = 8,  ///< amount: drift in degC/s
  kWriteRefused = 9,         ///< the drive keeps its last order and reports the refusal
  kOverrun = 10,             ///< amount: time in s that every write takes
  kSlowRead = 11,            ///< amount: time in s that every read takes
  kPowerLost = 12,           ///< no torque; the drive reports the loss of its supply
};
inline constexpr int kInjectedFaultCount = 13;
inline constexpr int kMaxSensorDelayPeriods = 1024;

/// One fault and its duration.
struct Injection {
  InjectedFault kind = InjectedFault::kNone;
  double at_s = 0.0;    ///< from the first period; a fault injected by message begins at once
  double for_s = 0.0;   ///< duration; 0: until it is ended
  double amount = 0.0;  ///< meaning and unit depend on the kind; ignored by kinds without one
};

/// Allowed values of Injection::amount.
struct AmountRange {
  double min;
  double max;
};
constexpr AmountRange amount_range(InjectedFault kind) noexcept {
  switch (kind) {
    case InjectedFault::kSensorNoisy:
      return {0.0, 10.0};
    case InjectedFault::kSensorDelayed:
      return {0.0, 1.0};
    case InjectedFault::kSensorJump:
      return {-100.0, 100.0};
    case InjectedFault::kTemperatureDrifting:
      return {-1000.0, 1000.0};
    case InjectedFault::kOverrun:
    case InjectedFault::kSlowRead:
      return {0.0, 1.0};
    default:
      return {0.0, 0.0};
  }
}

/// Unit of the amount; empty for the kinds without one.
std::string_view amount_unit(InjectedFault kind) noexcept;

/// Name in the configuration and on the command line, and the reverse, which returns nothing for an unknown name.
std::string_view to_text(InjectedFault kind) noexcept;
std::optional<InjectedFault> injected_fault_of(std::string_view text) noexcept;
/// Returns the kind with this number, if there is one.
std::optional<InjectedFault> injected_fault_of(std::int32_t number) noexcept;

}  // namespace strainwave
