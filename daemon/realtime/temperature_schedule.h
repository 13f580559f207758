// SPDX-License-Identifier: BSD-3-Clause
// When the gains follow the temperature: at a slower period of its own, joints in turn, so that no cycle pays for all of them.
// Real-time safe.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace strainwave {

class TemperatureSchedule {
 public:
  /// Every `update_period_s`, at least one period; `turn` is this joint's number among those that take turns.
  TemperatureSchedule(double update_period_s, double period_s, std::int64_t turn) noexcept
      : periods_(std::max<std::int64_t>(1, std::llround(update_period_s / period_s))), turn_(turn) {}

  /// The temperature for the gains in this cycle; the present one is `temperature_C`. With `at_once` it is used out of turn: gains that
  /// come into use begin with it.
  double follow_C(double temperature_C, std::int64_t cycle, bool at_once) noexcept {
    if (at_once || cycle >= next_cycle_) {
      scheduled_C_ = temperature_C;
      next_cycle_ = cycle + periods_ - (cycle + turn_) % periods_;
    }
    return scheduled_C_;
  }

  /// What the gains are for now.
  double scheduled_C() const noexcept { return scheduled_C_; }

 private:
  std::int64_t periods_;
  std::int64_t turn_;
  std::int64_t next_cycle_ = 0;
  double scheduled_C_ = 0.0;
};

}  // namespace strainwave
