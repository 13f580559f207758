// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/loop_controllers.h"

#include <cmath>
#include <utility>

#include "base/units.h"

namespace strainwave {

namespace {

// Breakaway takes more than the table's static friction, because its fit is only accurate to some per cent. A
// joint that is pushed too weakly stays in place until the integral has grown.
constexpr double kBreakaway = 1.0 + 0.1;
constexpr double kRestZone_rad = 1e-6;

}  // namespace

JointMeasurement measurement_of(const LoopSample& sample, double temperature_C) noexcept {
  JointMeasurement measurement;
  measurement.joint_position_rad = sample.joint_position_rad;
  measurement.joint_velocity_rad_s = sample.joint_velocity_rad_s.value_or(0.0);
  measurement.has_velocity = sample.joint_velocity_rad_s.has_value();
  measurement.temperature_C = temperature_C;
  measurement.temperature_valid = std::isfinite(temperature_C);
  return measurement;
}

FeedbackLoopController::FeedbackLoopController(const FeedbackGains& gains, const FuzzyFriction& friction,
                                               const PlantIdentity& plant, double torque_limit_Nm) noexcept
    : controller_(gains, friction, plant),
      table_(friction),
      friction_(friction.blend(controller_.temperature_weights())),
      compensates_(gains.scheduled()),
      difference_(plant.period_s),
      torque_limit_Nm_(torque_limit_Nm) {}

double FeedbackLoopController::friction_torque_Nm(const ControllerInput& input) const noexcept {
  const double way_rad = input.setpoint_position_rad - input.joint_position_rad;
  if (input.joint_velocity_rad_s == 0.0)
    return std::abs(way_rad) <= kRestZone_rad ? 0.0 : sign(way_rad) * kBreakaway * friction_.static_Nm;
  const double zero_weight = table_.velocity.zero_weight(input.joint_velocity_rad_s);
  return sign(way_rad) * zero_weight * friction_.static_Nm +
         sign(input.joint_velocity_rad_s) * (1.0 - zero_weight) * friction_.coulomb_Nm;
}

double FeedbackLoopController::torque_Nm(const LoopSample& sample) noexcept {
  if (std::isfinite(sample.temperature_C) && sample.temperature_C != temperature_C_) {
    controller_.set_temperature(sample.temperature_C);
    friction_ = table_.blend(controller_.temperature_weights());
    temperature_C_ = sample.temperature_C;
  }
  const double difference_rad_s = difference_.step(sample.joint_position_rad);
  ControllerInput input;
  input.joint_position_rad = sample.joint_position_rad;
  input.joint_velocity_rad_s = sample.joint_velocity_rad_s.value_or(difference_rad_s);
  input.setpoint_position_rad = sample.setpoint_position_rad;
  input.torque_limit_Nm = torque_limit_Nm_;
  const double before_rad =
      std::exchange(last_setpoint_rad_, sample.setpoint_position_rad).value_or(sample.joint_position_rad);
  if (before_rad != sample.setpoint_position_rad) input.jumped_from_rad = before_rad;
  if (compensates_) input.feedforward_torque_Nm = friction_torque_Nm(input);
  return controller_.step(input).torque_Nm;
}

void FeedbackLoopController::reset() noexcept {
  controller_.reset();
  difference_.reset();
  last_setpoint_rad_.reset();
}

double PidLoopController::torque_Nm(const LoopSample& sample) noexcept {
  const double error_rad = sample.setpoint_position_rad - sample.joint_position_rad;
  integral_rads_ += period_s_ * error_rad;
  return gains_.proportional_Nm_rad * error_rad + gains_.integral_Nm_rads * integral_rads_ +
         gains_.derivative_Nms_rad * derivative_.step(error_rad);
}

void PidLoopController::reset() noexcept {
  derivative_.reset();
  integral_rads_ = 0.0;
}

}  // namespace strainwave
