// SPDX-License-Identifier: BSD-3-Clause
#include "control/law_in_use.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Largest torque per rad of a reading: through the position, and through the velocity that differences of readings give.
double largest_gain_Nm_rad(const GainTable& table, double velocity_by_rad) noexcept {
  double largest = 0.0;
  for (int rule = 0; rule < table.primary.rule_count; ++rule) {
    const GainRow gain = table.primary.gain(rule);
    largest = std::max(largest, std::abs(gain(1)) + std::abs(gain(2)) * velocity_by_rad);
  }
  return largest;
}

}  // namespace

void LawInUse::load(const GainTable& table) noexcept {
  if (loaded_ && !outgoing_) outgoing_ = law_;
  const double lead_periods = table.box.lead_periods;
  law_ = ScheduledController(table.primary, table.friction, table.plant, lead_periods);
  if (temperature_C_) law_.set_temperature(*temperature_C_);
  count_torque_Nm_ = encoder_resolution_rad_ * largest_gain_Nm_rad(table, velocity_share_ / period_s_) *
                     (1.0 + lead_periods);
  zero_velocity_weight_ = table.friction.velocity.zero_weight(0.0);
  loaded_ = true;
}

void LawInUse::begin_anew() noexcept {
  law_.reset();
  outgoing_.reset();
}

bool LawInUse::set_temperature(double temperature_C) noexcept {
  if (temperature_C_ == temperature_C) return false;
  law_.set_temperature(temperature_C);
  temperature_C_ = temperature_C;
  return true;
}

ControllerOutput LawInUse::step(const ControllerInput& input) noexcept {
  if (outgoing_) {
    const std::optional<double> last_law_Nm = outgoing_->last_law_Nm();
    law_.carry_over(input, outgoing_->step(input).torque_Nm, last_law_Nm);
  }
  outgoing_.reset();
  return law_.step(input);
}

}  // namespace strainwave
