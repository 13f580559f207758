// SPDX-License-Identifier: BSD-3-Clause
#include "strainwave/state.h"

#include <algorithm>
#include <iterator>

#include "base/printable.h"
#include "lcmtypes/cycle_fields.h"

namespace strainwave {

State::State(const state_v1& message, std::chrono::steady_clock::time_point when)
    : state_v1(message),
      mode(static_cast<Mode>(message.mode)),
      fault(static_cast<Fault>(message.fault)),
      temperature_status(static_cast<TemperatureStatus>(message.temperature_status)),
      received(when) {}

std::span<const double> State::weights() const noexcept {
  const auto rules = static_cast<std::size_t>(std::max(rule_count, 0));
  return std::span<const double>(temperature_weights).first(std::min(rules, std::size(temperature_weights)));
}

double State::tracking_error_rad() const noexcept {
  return strainwave::tracking_error_rad(static_cast<const state_v1&>(*this));
}

Limits::Limits(const limits_v1& message)
    : limits_v1(message),
      joint_model(printable(std::string(std::begin(message.joint_model), std::end(message.joint_model)))) {}

}  // namespace strainwave
