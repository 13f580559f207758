// SPDX-License-Identifier: BSD-3-Clause
// What the daemon publishes of a joint, with numbers by name. The fields are those of docs/messages.md, joint side, SI. Not real-time.
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

  /// Whether the limit is in force.
  bool has(Notice notice) const noexcept { return (notices & static_cast<std::int32_t>(notice)) != 0; }

  /// Weights of the temperature rules, as many as the table has.
  std::span<const double> weights() const noexcept;

  /// Where the joint should be read in this cycle, less where it is read.
  double tracking_error_rad() const noexcept;
};

/// limits_v1: what the joint is and how far it may go.
struct Limits : limits_v1 {
  explicit Limits(const limits_v1& message);

  std::string joint_model;
};

}  // namespace strainwave
