// SPDX-License-Identifier: BSD-3-Clause
#include "commission/motion_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strainwave {

double MeanSpeed::step(double position_rad) {
  const std::size_t kept = std::min(count_, positions_rad_.size());
  double& oldest = positions_rad_[count_ % positions_rad_.size()];
  const double from_rad = kept == positions_rad_.size() ? oldest : positions_rad_.front();
  oldest = position_rad;
  ++count_;
  return kept == 0 ? 0.0 : (position_rad - from_rad) / (period_s_ * static_cast<double>(kept));
}

std::optional<std::string> MotionGuard::judge(const ActuatorReading& reading, double speed_rad_s,
                                              bool enabled) {
  if (reading.fault != ActuatorFault::kNone)
    return fmt::format("the drive reports fault {} (error {}): see docs/faults.md",
                       static_cast<int>(reading.fault), reading.drive_error);
  if (reading.position_lost)
    return std::string("the encoder's count may be wrong: check the encoder's cable");
  missing_periods_ = reading.has_position ? 0 : missing_periods_ + 1;
  if (missing_periods_ >= kMissingPeriods)
    return fmt::format("no position for {} periods: check the bus", missing_periods_);
  if (enabled) {
    const bool ready = reading.drive_state == DriveState::kEnabled;
    if (was_enabled_ && !ready) return std::string("the drive has switched its torque off");
    was_enabled_ = was_enabled_ || ready;
    if (!ready && ++enabling_periods_ > kEnablePeriods)
      return fmt::format("the drive is not ready {} periods after its enable: check its supply",
                         enabling_periods_ - 1);
  }
  if (reading.inputs.negative_limit || reading.inputs.positive_limit)
    return fmt::format("a limit switch is active at {:.4f} rad", reading.joint_position_rad);
  if (reading.joint_position_rad < limits_.position_min_rad ||
      reading.joint_position_rad > limits_.position_max_rad)
    return fmt::format("position {:.4f} rad is outside {:.4f} to {:.4f} rad", reading.joint_position_rad,
                       limits_.position_min_rad, limits_.position_max_rad);
  if (std::abs(speed_rad_s) > limits_.speed_rad_s)
    return fmt::format("speed {:.3f} rad/s at {:.4f} rad is above {:.3f} rad/s", speed_rad_s,
                       reading.joint_position_rad, limits_.speed_rad_s);
  return std::nullopt;
}

}  // namespace strainwave
