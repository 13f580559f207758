#include "control/joint_controller.h"

#include <algorithm>

namespace strainwave {

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config), shaper_(config.period_s) {
  shaper_.set_limits(config.motion);
}

void JointController::load(const GainTable& table) noexcept {
  primary_ = ScheduledController(table.primary, table.friction, table.plant);
  fallback_ = ScheduledController(table.fallback, table.friction, table.plant);
  table_torque_limit_Nm_ = table.torque_limit_Nm;
  carry_over_ = gains_in_use_ != GainsInUse::kNone;
  has_table_ = true;
  has_temperature_ = false;
}

void JointController::start(double position_rad) noexcept {
  shaper_.reset(position_rad, 0.0);
  primary_.reset();
  fallback_.reset();
  gains_in_use_ = GainsInUse::kNone;
  previous_position_rad_ = position_rad;
  previous_torque_Nm_ = 0.0;
  carry_over_ = false;
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!has_table_) return {};
  choose_gains(measurement);
  ControllerInput input;
  input.joint_position_rad = measurement.joint_position_rad;
  input.joint_velocity_rad_s = estimate_velocity(measurement);
  const Reference reference = next_reference();
  input.setpoint_position_rad = reference.position_rad;
  input.setpoint_velocity_rad_s = reference.velocity_rad_s;
  input.setpoint_acceleration_rad_s2 = reference.acceleration_rad_s2;
  input.torque_limit_Nm = std::min(config_.torque_limit_Nm, table_torque_limit_Nm_);
  if (carry_over_) active().carry_over(input, previous_torque_Nm_);
  carry_over_ = false;
  const ControllerOutput output = active().step(input);
  previous_torque_Nm_ = output.torque_Nm;
  return {output, reference, input.joint_velocity_rad_s, gains_in_use_, shaper_.at_target()};
}

// Scheduled gains while the temperature is known, temperature-free ones otherwise.
void JointController::choose_gains(const JointMeasurement& measurement) noexcept {
  const GainsInUse wanted = measurement.temperature_valid ? GainsInUse::kPrimary : GainsInUse::kFallback;
  if (wanted != gains_in_use_) {
    carry_over_ = gains_in_use_ != GainsInUse::kNone;
    gains_in_use_ = wanted;
  }
  if (!measurement.temperature_valid) return;
  if (has_temperature_ && measurement.temperature_C == scheduled_temperature_C_) return;
  primary_.set_temperature(measurement.temperature_C);
  scheduled_temperature_C_ = measurement.temperature_C;
  has_temperature_ = true;
}

double JointController::estimate_velocity(const JointMeasurement& measurement) noexcept {
  const double moved_rad = measurement.joint_position_rad - previous_position_rad_;
  previous_position_rad_ = measurement.joint_position_rad;
  return measurement.has_velocity ? measurement.joint_velocity_rad_s : moved_rad / config_.period_s;
}

Reference JointController::next_reference() noexcept {
  const Reference shaped = shaper_.step();
  return config_.use_shaping ? shaped : Reference{shaper_.target_rad(), 0.0, 0.0};
}

}  // namespace strainwave
