// SPDX-License-Identifier: BSD-3-Clause
#include "control/scheduled_controller.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

double position_error_rad(const ControllerInput& input) noexcept {
  return input.joint_position_rad - input.setpoint_position_rad;
}

double velocity_error_rad_s(const ControllerInput& input) noexcept {
  return input.joint_velocity_rad_s - input.setpoint_velocity_rad_s;
}

}  // namespace

ScheduledController::ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction,
                                         const PlantIdentity& plant, double lead_periods) noexcept
    : friction_(friction),
      zero_velocity_gain_(gains.gain(0)),
      period_s_(plant.period_s),
      lead_periods_(lead_periods),
      scheduled_(gains.scheduled()),
      has_integrator_(gains.has_integrator != 0) {
  for (int i = 0; i < friction.rule_count; ++i)
    rules_[static_cast<std::size_t>(i)] = gains.gain(scheduled_ ? i + 1 : 0);
  const StateMatrix P = gains.lyapunov(0);
  if (has_integrator_ && P(0, 0) > 0.0) {
    position_share_s_ = P(0, 1) / P(0, 0);
    velocity_share_s2_ = P(0, 2) / P(0, 0);
  }
  set_temperature(0.5 * (friction.temperature_min_C + friction.temperature_max_C));
}

void ScheduledController::set_temperature(double temperature_C) noexcept {
  weights_ = friction_.weights(temperature_C);
  high_velocity_gain_.setZero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights_.count); ++i)
    high_velocity_gain_ += weights_.weight[i] * rules_[i];
}

ScheduledController::Terms ScheduledController::evaluate(const ControllerInput& input) const noexcept {
  const StateVector x{integral_rad_s_, position_error_rad(input), velocity_error_rad_s(input)};
  if (!scheduled_) return {zero_velocity_gain_.dot(x), zero_velocity_gain_(0), 1.0};

  const double zero_weight = friction_.velocity.zero_weight(input.joint_velocity_rad_s);
  const double at_zero_Nm = zero_velocity_gain_.dot(x);
  const double at_speed_Nm = high_velocity_gain_.dot(x);
  return {at_speed_Nm + zero_weight * (at_zero_Nm - at_speed_Nm),
          high_velocity_gain_(0) + zero_weight * (zero_velocity_gain_(0) - high_velocity_gain_(0)),
          zero_weight};
}

double ScheduledController::fast_part(const ControllerInput& input,
                                      double setpoint_position_rad) const noexcept {
  return position_share_s_ * (input.joint_position_rad - setpoint_position_rad) +
         velocity_share_s2_ * velocity_error_rad_s(input);
}

// Keeps the integral's slow part through saturation and setpoint jumps.
void ScheduledController::keep_slow_part(const ControllerInput& input) noexcept {
  if (!has_integrator_) return;
  const bool jumped = input.jumped_from_rad.has_value();
  if (jumped && !saturated_) slow_rad_s_ = integral_rad_s_ + fast_part(input, *input.jumped_from_rad);
  if (jumped || saturated_) integral_rad_s_ = slow_rad_s_ - fast_part(input, input.setpoint_position_rad);
  if (jumped) interrupt();
}

// Factor of the lead in u = l + factor (l - last l); 0 if the last l is unknown.
double ScheduledController::lead_in(const ControllerInput& input) const noexcept {
  return last_law_Nm_ ? lead_periods_ / std::max(1, input.elapsed_periods) : 0.0;
}

ControllerOutput ScheduledController::step(const ControllerInput& input) noexcept {
  keep_slow_part(input);
  const Terms terms = evaluate(input);
  const double lead = lead_in(input);
  const double feedback_Nm =
      lead == 0.0 ? terms.law_Nm : terms.law_Nm + lead * (terms.law_Nm - *last_law_Nm_);
  const double wanted_Nm = feedback_Nm + input.feedforward_torque_Nm;
  const double lowest_Nm = std::max(-input.torque_limit_Nm, input.torque_min_Nm);
  const double highest_Nm = std::min(input.torque_limit_Nm, input.torque_max_Nm);
  const double torque_Nm = std::min(std::max(wanted_Nm, lowest_Nm), highest_Nm);
  saturated_ = torque_Nm != wanted_Nm;
  slow_rad_s_ = integral_rad_s_ + fast_part(input, input.setpoint_position_rad);
  if (has_integrator_) integral_rad_s_ += period_s_ * position_error_rad(input);
  last_law_Nm_ = terms.law_Nm;
  return {torque_Nm, feedback_Nm, input.feedforward_torque_Nm, terms.zero_weight, saturated_};
}

void ScheduledController::reset() noexcept {
  integral_rad_s_ = 0.0;
  slow_rad_s_ = 0.0;
  interrupt();
  saturated_ = false;
}

double ScheduledController::integral_torque_Nm() const noexcept {
  if (!scheduled_) return zero_velocity_gain_(0) * integral_rad_s_;
  const double zero_weight = friction_.velocity.zero_weight(0.0);
  return (zero_weight * zero_velocity_gain_(0) + (1.0 - zero_weight) * high_velocity_gain_(0)) *
         integral_rad_s_;
}

void ScheduledController::carry_over(const ControllerInput& input, double torque_Nm,
                                     std::optional<double> last_law_Nm) noexcept {
  last_law_Nm_ = last_law_Nm;
  saturated_ = false;
  if (!has_integrator_) return;
  const Terms terms = evaluate(input);
  if (terms.integral_gain == 0.0) return;
  const double lead = lead_in(input);
  const double feedback_Nm = torque_Nm - input.feedforward_torque_Nm;
  const double law_Nm = lead == 0.0 ? feedback_Nm : (feedback_Nm + lead * *last_law_Nm_) / (1.0 + lead);
  integral_rad_s_ += (law_Nm - terms.law_Nm) / terms.integral_gain;
}

}  // namespace strainwave
