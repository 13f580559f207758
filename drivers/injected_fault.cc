// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/injected_fault.h"

#include <array>

namespace strainwave {

namespace {

constexpr std::array<std::string_view, kInjectedFaultCount> kNames{
    "none",        "sensor_stuck",     "sensor_nan",        "sensor_noisy",         "sensor_delayed",
    "sensor_jump", "temperature_lost", "temperature_stuck", "temperature_drifting", "write_refused",
    "overrun",     "slow_read",        "power_lost",
};

}  // namespace

std::string_view to_text(InjectedFault kind) noexcept {
  const auto number = static_cast<std::int32_t>(kind);
  return injected_fault_of(number) ? kNames[static_cast<std::size_t>(number)] : "unknown";
}

std::string_view amount_unit(InjectedFault kind) noexcept {
  switch (kind) {
    case InjectedFault::kSensorNoisy:
    case InjectedFault::kSensorJump:
      return "rad";
    case InjectedFault::kTemperatureDrifting:
      return "degC/s";
    case InjectedFault::kSensorDelayed:
    case InjectedFault::kOverrun:
    case InjectedFault::kSlowRead:
      return "s";
    default:
      return "";
  }
}

std::optional<InjectedFault> injected_fault_of(std::string_view text) noexcept {
  for (std::int32_t number = 0; number < kInjectedFaultCount; ++number)
    if (kNames[static_cast<std::size_t>(number)] == text) return static_cast<InjectedFault>(number);
  return std::nullopt;
}

std::optional<InjectedFault> injected_fault_of(std::int32_t number) noexcept {
  if (number < 0 || number >= kInjectedFaultCount) return std::nullopt;
  return static_cast<InjectedFault>(number);
}

}  // namespace strainwave
