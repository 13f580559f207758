// SPDX-License-Identifier: BSD-3-Clause
// Messages of the daemon about a joint, with enumerations for codes. docs/messages.md lists the fields: joint side, SI. Not real-time.
#pragma once

#include <chrono>
#include <span>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <string>

#include "strainwave/vocabulary.h"

namespace strainwave {

/// state_v1: what the joint does in one cycle.
struct State : state_v1 {
  State(const state_v1& message, std::chrono::steady_clock::time_point received);

  Mode mode;
  Fault fault;
  TemperatureStatus temperature_status;
  std::chrono::steady_clock::time_point received;  ///< by this machine's clock

  /// Whether `notice` is set.
  bool has(Notice notice) const noexcept { return (notices & static_cast<std::int32_t>(notice)) != 0; }

  /// Weights of the temperature rules, as many as the table has.
  std::span<const double> weights() const noexcept;

  /// Returns the position setpoint of this cycle minus the measured position.
  double tracking_error_rad() const noexcept;
};

/// limits_v1: the data and the limits of the joint.
struct Limits : limits_v1 {
  explicit Limits(const limits_v1& message);

  std::string joint_model;
};

}  // namespace strainwave
