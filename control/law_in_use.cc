#include "control/law_in_use.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strainwave {

namespace {

// Share of its gains that a law keeps which chatters on by itself. Softer ones are not certified; the certified ones shake the joint.
constexpr double kSoftShare = 0.25;

// Torque that a count makes, per rad: by the position, and by the velocity where that is the difference of two readings.
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
  keep_outgoing();
  const double lead_periods = told_of_spring_ ? table.box.lead_periods : 0.0;
  primary_ = ScheduledController(table.primary, table.friction, table.plant, lead_periods);
  fallback_ = ScheduledController(table.fallback, table.friction, table.plant, lead_periods);
  if (temperature_C_) primary_.set_temperature(*temperature_C_);
  position_count_Nm_ = encoder_resolution_rad_ * largest_gain_Nm_rad(table, 0.0);
  reading_count_Nm_ = encoder_resolution_rad_ * largest_gain_Nm_rad(table, velocity_share_ / period_s_) *
                      (1.0 + lead_periods);
  zero_velocity_weight_ = table.friction.velocity.zero_weight(0.0);
  if (std::exchange(soft_, false)) soften();
  loaded_ = true;
}

void LawInUse::begin_anew() noexcept {
  set_soft(false);
  primary_.reset();
  fallback_.reset();
  outgoing_.reset();
  gains_in_use_ = GainsInUse::kNone;
}

void LawInUse::choose_gains(const std::optional<double>& temperature_C) noexcept {
  const GainsInUse wanted = temperature_C ? GainsInUse::kPrimary : GainsInUse::kFallback;
  if (wanted != gains_in_use_) {
    keep_outgoing();
    gains_in_use_ = wanted;
  }
  if (!temperature_C || temperature_C_ == temperature_C) return;
  primary_.set_temperature(*temperature_C);
  temperature_C_ = temperature_C;
}

ControllerOutput LawInUse::step(const ControllerInput& input) noexcept {
  if (outgoing_) {
    const std::optional<double> last_law_Nm = outgoing_->last_law_Nm();
    active().carry_over(input, outgoing_->step(input).torque_Nm, last_law_Nm);
  }
  outgoing_.reset();
  return active().step(input);
}

void LawInUse::keep_outgoing() noexcept {
  if (gains_in_use_ != GainsInUse::kNone && !outgoing_) outgoing_ = active();
}

// Both controllers' gains, and with them what a count makes, down or back up again.
void LawInUse::set_soft(bool soft) noexcept {
  if (soft == soft_) return;
  soft_ = soft;
  const double share = soft ? kSoftShare : 1.0 / kSoftShare;
  for (ScheduledController* controller : {&primary_, &fallback_}) controller->soften(share);
  position_count_Nm_ *= share;
  reading_count_Nm_ *= share;
}

}  // namespace strainwave
