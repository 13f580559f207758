// SPDX-License-Identifier: BSD-3-Clause
#include "control/scheduled_controller.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

// More than the table's static friction to break away: its fit is no better than some per cent, and a joint
// that is pushed too weakly stays where it is until the integral has grown.
constexpr double kBreakawayMargin = 0.1;

double position_error_rad(const ControllerInput& input) noexcept {
  return input.joint_position_rad - input.setpoint_position_rad;
}

double velocity_error_rad_s(const ControllerInput& input) noexcept {
  return input.joint_velocity_rad_s - input.setpoint_velocity_rad_s;
}

}  // namespace

ScheduledController::ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction,
                                         const PlantIdentity& plant, double lead_periods) noexcept
    : memberships_(friction),
      zero_weight_(friction.velocity),
      zero_velocity_gain_(gains.gain(0)),
      period_s_(plant.period_s),
      lead_periods_(lead_periods),
      scheduled_(gains.scheduled()),
      has_integrator_(gains.has_integrator != 0) {
  for (int i = 0; i < friction.rule_count; ++i) {
    const FrictionParameters& parameters = friction.rules[static_cast<std::size_t>(i)].friction;
    rules_.col(i) << parameters.static_Nm, parameters.coulomb_Nm, parameters.viscous_Nms_rad,
        gains.gain(scheduled_ ? i + 1 : 0).transpose();
  }
  const StateMatrix P = gains.lyapunov(0);
  if (has_integrator_ && P(0, 0) > 0.0) {
    position_share_s_ = P(0, 1) / P(0, 0);
    velocity_share_s2_ = P(0, 2) / P(0, 0);
  }
  set_temperature(0.5 * (friction.temperature_min_C + friction.temperature_max_C));
}

void ScheduledController::set_temperature(double temperature_C) noexcept {
  const double scale = memberships_.evaluate(temperature_C, weights_);
  Blend blend = Blend::Zero();
  for (int i = 0; i < weights_.count; ++i)
    blend += weights_.weight[static_cast<std::size_t>(i)] * rules_.col(i);
  // Normalised last: the sum of the memberships and its
  // reciprocal are computed beside the blend, not before it.
  blend *= scale;
  weights_.scale_by(scale);
  blended_friction_ = {blend(0), blend(1), blend(2)};
  high_velocity_gain_ = blend.tail<3>().transpose();
}

double ScheduledController::friction_torque_Nm(const ControllerInput& input,
                                               double zero_weight) const noexcept {
  const double error_rad = position_error_rad(input);
  if (input.joint_velocity_rad_s == 0.0) {
    if (std::abs(error_rad) <= input.rest_zone_rad) return 0.0;
    return -sign(error_rad) * (1.0 + kBreakawayMargin) * blended_friction_.static_Nm;
  }
  return -sign(error_rad) * zero_weight * blended_friction_.static_Nm +
         sign(input.joint_velocity_rad_s) * (1.0 - zero_weight) * blended_friction_.coulomb_Nm;
}

ScheduledController::Terms ScheduledController::evaluate(const ControllerInput& input) const noexcept {
  const StateVector x{integral_rad_s_, position_error_rad(input), velocity_error_rad_s(input)};
  const double planned_Nm = input.planned_torque_Nm;
  if (!scheduled_) return {zero_velocity_gain_.dot(x), planned_Nm, zero_velocity_gain_(0), 1.0};

  const double zero_weight = zero_weight_.at(input.joint_velocity_rad_s);
  const double at_zero_Nm = zero_velocity_gain_.dot(x);
  const double at_speed_Nm = high_velocity_gain_.dot(x);
  const double feedforward_Nm = planned_Nm + (input.planned ? 0.0 : friction_torque_Nm(input, zero_weight));
  return {at_speed_Nm + zero_weight * (at_zero_Nm - at_speed_Nm), feedforward_Nm,
          high_velocity_gain_(0) + zero_weight * (zero_velocity_gain_(0) - high_velocity_gain_(0)),
          zero_weight};
}

double ScheduledController::fast_part(const ControllerInput& input,
                                      double setpoint_position_rad) const noexcept {
  return position_share_s_ * (input.joint_position_rad - setpoint_position_rad) +
         velocity_share_s2_ * velocity_error_rad_s(input);
}

// Saturation and setpoint jumps leave the slow part of the state as it was; planned motion makes no jumps.
void ScheduledController::keep_slow_part(const ControllerInput& input) noexcept {
  if (!has_integrator_) return;
  const double last_setpoint_rad = has_setpoint_ ? last_setpoint_rad_ : input.joint_position_rad;
  const bool jumped = !input.planned && input.setpoint_position_rad != last_setpoint_rad;
  if (jumped && !saturated_) slow_rad_s_ = integral_rad_s_ + fast_part(input, last_setpoint_rad);
  if (jumped || saturated_) integral_rad_s_ = slow_rad_s_ - fast_part(input, input.setpoint_position_rad);
  if (jumped) interrupt();
}

// u = l + lead (l - l one period ago).
double ScheduledController::lead_in(const ControllerInput& input) const noexcept {
  return last_law_Nm_ ? lead_periods_ / std::max(1, input.elapsed_periods) : 0.0;
}

ControllerOutput ScheduledController::step(const ControllerInput& input) noexcept {
  keep_slow_part(input);
  const Terms terms = evaluate(input);
  const double lead = lead_in(input);
  const double feedback_Nm =
      lead == 0.0 ? terms.law_Nm : terms.law_Nm + lead * (terms.law_Nm - *last_law_Nm_);
  const double wanted_Nm = feedback_Nm + terms.feedforward_Nm;
  const double lowest_Nm = std::max(-input.torque_limit_Nm, input.torque_min_Nm);
  const double highest_Nm = std::min(input.torque_limit_Nm, input.torque_max_Nm);
  const double torque_Nm = std::min(std::max(wanted_Nm, lowest_Nm), highest_Nm);
  saturated_ = torque_Nm != wanted_Nm;
  slow_rad_s_ = integral_rad_s_ + fast_part(input, input.setpoint_position_rad);
  if (has_integrator_) integral_rad_s_ += period_s_ * position_error_rad(input);
  last_law_Nm_ = terms.law_Nm;
  last_setpoint_rad_ = input.setpoint_position_rad;
  has_setpoint_ = true;
  return {torque_Nm, feedback_Nm, terms.feedforward_Nm, terms.zero_weight, saturated_};
}

void ScheduledController::reset() noexcept {
  integral_rad_s_ = 0.0;
  slow_rad_s_ = 0.0;
  interrupt();
  has_setpoint_ = false;
  saturated_ = false;
}

double ScheduledController::integral_torque_Nm() const noexcept {
  if (!scheduled_) return zero_velocity_gain_(0) * integral_rad_s_;
  const double zero_weight = zero_weight_.at(0.0);
  return (zero_weight * zero_velocity_gain_(0) + (1.0 - zero_weight) * high_velocity_gain_(0)) *
         integral_rad_s_;
}

void ScheduledController::carry_over(const ControllerInput& input, double torque_Nm,
                                     std::optional<double> last_law_Nm) noexcept {
  last_law_Nm_ = last_law_Nm;
  last_setpoint_rad_ = input.setpoint_position_rad;
  has_setpoint_ = true;
  saturated_ = false;
  if (!has_integrator_) return;
  const Terms terms = evaluate(input);
  if (terms.integral_gain == 0.0) return;
  const double lead = lead_in(input);
  const double feedback_Nm = torque_Nm - terms.feedforward_Nm;
  const double law_Nm = lead == 0.0 ? feedback_Nm : (feedback_Nm + lead * *last_law_Nm_) / (1.0 + lead);
  integral_rad_s_ += (law_Nm - terms.law_Nm) / terms.integral_gain;
}

}  // namespace strainwave
