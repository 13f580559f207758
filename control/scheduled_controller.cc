#include "control/scheduled_controller.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

StateVector error_state(const ControllerInput& input, double integral_rad_s) noexcept {
  return {integral_rad_s, input.joint_position_rad - input.setpoint_position_rad,
          input.joint_velocity_rad_s - input.setpoint_velocity_rad_s};
}

// The way the joint is being driven: the way it is meant to move, or, for a step reference, the way the feedback pulls.
double drive_direction(const ControllerInput& input, double feedback_Nm) noexcept {
  return input.setpoint_velocity_rad_s != 0.0 ? sign(input.setpoint_velocity_rad_s) : sign(feedback_Nm);
}

// Friction in motion opposes the velocity; at rest it opposes the drive.
double motion_direction(const ControllerInput& input, double drive) noexcept {
  return input.joint_velocity_rad_s != 0.0 ? sign(input.joint_velocity_rad_s) : drive;
}

}  // namespace

ScheduledController::ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction,
                                         const PlantIdentity& plant) noexcept
    : gains_(gains), friction_(friction), plant_(plant) {
  set_temperature(0.5 * (friction.temperature_min_C + friction.temperature_max_C));
}

void ScheduledController::set_temperature(double temperature_C) noexcept {
  weights_ = friction_.weights(temperature_C);
  if (!gains_.scheduled()) {
    high_velocity_gain_ = gains_.gain(0);
    return;
  }
  blended_friction_ = friction_.blend(weights_);
  high_velocity_gain_.setZero();
  for (int i = 0; i < weights_.count; ++i)
    high_velocity_gain_ += weights_.weight[static_cast<std::size_t>(i)] * gains_.gain(i + 1);
}

ScheduledController::Terms ScheduledController::evaluate(const ControllerInput& input,
                                                         double integral_rad_s) const noexcept {
  const StateVector x = error_state(input, integral_rad_s);
  const double inertial_Nm = plant_.inertia_kgm2 * input.setpoint_acceleration_rad_s2;
  if (!gains_.scheduled()) return {high_velocity_gain_.dot(x), inertial_Nm, high_velocity_gain_(0), 1.0};

  const double zero = friction_.velocity.zero_weight(input.joint_velocity_rad_s);
  const double high = 1.0 - zero;
  const GainRow gain = zero * gains_.gain(0) + high * high_velocity_gain_;
  const double feedback_Nm = gain.dot(x);
  const double drive = drive_direction(input, feedback_Nm);
  const double friction_Nm = zero * blended_friction_.static_Nm * drive +
                             high * blended_friction_.coulomb_Nm * motion_direction(input, drive);
  const double viscous_Nm = high * blended_friction_.viscous_Nms_rad * input.setpoint_velocity_rad_s;
  return {feedback_Nm, friction_Nm + viscous_Nm + inertial_Nm, gain(0), zero};
}

ControllerOutput ScheduledController::step(const ControllerInput& input) noexcept {
  const Terms terms = evaluate(input, integral_rad_s_);
  const double wanted_Nm = terms.feedback_Nm + terms.feedforward_Nm;
  const double torque_Nm = std::clamp(wanted_Nm, -input.torque_limit_Nm, input.torque_limit_Nm);
  const double excess_Nm = wanted_Nm - torque_Nm;

  // Anti-windup: while saturated the integral may only move so as to leave saturation.
  const double error_rad = input.joint_position_rad - input.setpoint_position_rad;
  const bool winds_up = excess_Nm * terms.integral_gain * error_rad > 0.0;
  if (gains_.has_integrator != 0 && !winds_up) integral_rad_s_ += plant_.period_s * error_rad;

  return {torque_Nm, terms.feedback_Nm, terms.feedforward_Nm, terms.zero_weight, excess_Nm != 0.0};
}

void ScheduledController::carry_over(const ControllerInput& input, double torque_Nm) noexcept {
  if (gains_.has_integrator == 0) return;
  // The feed-forward's direction may follow the sign of the feedback, which depends on the integral sought: two passes
  // settle it, and where both signs are consistent the first one found is kept.
  for (int pass = 0; pass < 2; ++pass) {
    const Terms terms = evaluate(input, integral_rad_s_);
    if (terms.integral_gain == 0.0) return;
    integral_rad_s_ += (torque_Nm - terms.feedback_Nm - terms.feedforward_Nm) / terms.integral_gain;
  }
}

}  // namespace strainwave
