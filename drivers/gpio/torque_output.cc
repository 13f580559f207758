// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/torque_output.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

TorqueOutput::TorqueOutput(const TorqueOutputConfig& config) noexcept
    : config_(config),
      // At least one period: the bridge may apply the new duty only at the end of its own period.
      dead_periods_(
          std::max<std::int64_t>(1, std::llround(std::ceil(config.dead_time_s / config.period_s - 1e-9)))) {}

double TorqueOutput::share_of(double torque_Nm, double joint_velocity_rad_s) const noexcept {
  const MotorLimits& motor = config_.motor;
  const double share =
      config_.amplifier == AmplifierKind::kCurrent
          ? torque_Nm / config_.full_scale_Nm
          : (torque_Nm + motor.torque_per_speed_Nms_rad * joint_velocity_rad_s) / motor.stall_torque_Nm;
  return std::clamp(share, -1.0, 1.0);
}

double TorqueOutput::torque_of(double share, double joint_velocity_rad_s) const noexcept {
  const MotorLimits& motor = config_.motor;
  return config_.amplifier == AmplifierKind::kCurrent
             ? share * config_.full_scale_Nm
             : share * motor.stall_torque_Nm - motor.torque_per_speed_Nms_rad * joint_velocity_rad_s;
}

double TorqueOutput::limit_slew(double torque_Nm) noexcept {
  const double step_Nm = config_.slew_Nm_s * config_.period_s;
  torque_Nm_ = step_Nm > 0.0 ? torque_Nm_ + std::clamp(torque_Nm - torque_Nm_, -step_Nm, step_Nm) : torque_Nm;
  return torque_Nm_;
}

// Keeps rounding errors from exceeding the limits.
double TorqueOutput::limited(double duty) const noexcept {
  return std::clamp(duty, config_.duty_min, config_.duty_max);
}

double TorqueOutput::idle_duty() const noexcept {
  return config_.bridge == BridgeKind::kSignMagnitude ? config_.duty_min
                                                      : 0.5 * (config_.duty_min + config_.duty_max);
}

TorqueOutput::Output TorqueOutput::idle() noexcept {
  torque_Nm_ = 0.0;
  waited_periods_ = 0;
  return {idle_duty(), negative_, 0.0};
}

TorqueOutput::Output TorqueOutput::step(double torque_Nm, double joint_velocity_rad_s) noexcept {
  if (!std::isfinite(torque_Nm)) return idle();
  const double share = share_of(limit_slew(torque_Nm), joint_velocity_rad_s);
  const double applied_Nm = torque_of(share, joint_velocity_rad_s);
  const double outward = config_.reversed ? -share : share;
  const double span = config_.duty_max - config_.duty_min;
  if (config_.bridge == BridgeKind::kLockedAntiphase)
    return {limited(idle_duty() + 0.5 * outward * span), false, applied_Nm};

  const bool wants_change = outward != 0.0 && (outward < 0.0) != negative_;
  if (wants_change && waited_periods_ < dead_periods_) {
    ++waited_periods_;
    return {idle_duty(), negative_, torque_of(0.0, joint_velocity_rad_s)};
  }
  waited_periods_ = 0;
  if (wants_change) negative_ = !negative_;
  return {limited(config_.duty_min + std::abs(outward) * span), negative_, applied_Nm};
}

}  // namespace strainwave
