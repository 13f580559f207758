// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/loop_controllers.h"

#include <cmath>

namespace strainwave {

JointMeasurement measurement_of(const LoopSample& sample, double temperature_C) noexcept {
  JointMeasurement measurement;
  measurement.joint_position_rad = sample.joint_position_rad;
  measurement.joint_velocity_rad_s = sample.joint_velocity_rad_s.value_or(0.0);
  measurement.has_velocity = sample.joint_velocity_rad_s.has_value();
  measurement.temperature_C = temperature_C;
  measurement.temperature_valid = std::isfinite(temperature_C);
  return measurement;
}

double FeedbackLoopController::torque_Nm(const LoopSample& sample) noexcept {
  if (std::isfinite(sample.temperature_C) && sample.temperature_C != temperature_C_) {
    controller_.set_temperature(sample.temperature_C);
    temperature_C_ = sample.temperature_C;
  }
  const double difference_rad_s = difference_.step(sample.joint_position_rad);
  ControllerInput input;
  input.joint_position_rad = sample.joint_position_rad;
  input.joint_velocity_rad_s = sample.joint_velocity_rad_s.value_or(difference_rad_s);
  input.setpoint_position_rad = sample.setpoint_position_rad;
  input.torque_limit_Nm = torque_limit_Nm_;
  return controller_.step(input).torque_Nm;
}

void FeedbackLoopController::reset() noexcept {
  controller_.reset();
  difference_.reset();
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
