// SPDX-License-Identifier: BSD-3-Clause
#include "commission/motion_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// A jump is implausible above this multiple of the distance that the speed limit allows in kMissingPeriods.
constexpr double kJump = 2.0;

}  // namespace

double MeanSpeed::step(double position_rad) {
  const std::size_t kept = std::min(count_, positions_rad_.size());
  double& oldest = positions_rad_[count_ % positions_rad_.size()];
  const double from_rad = kept == positions_rad_.size() ? oldest : positions_rad_.front();
  oldest = position_rad;
  ++count_;
  return kept == 0 ? 0.0 : (position_rad - from_rad) / (period_s_ * static_cast<double>(kept));
}

std::optional<std::string> MotionGuard::judge_position(const ActuatorReading& reading) {
  blind_ = true;
  if (reading.position_lost)
    return std::string("the encoder's count may be wrong: check the encoder's cable");
  missing_periods_ = reading.has_position ? 0 : missing_periods_ + 1;
  if (missing_periods_ >= kMissingPeriods)
    return fmt::format("no position for {} periods: check the bus", missing_periods_);
  const double position_rad = reading.joint_position_rad;
  const double way_rad = std::abs(position_rad - last_position_rad_.value_or(position_rad));
  if (!(way_rad <= kJump * limits_.speed_rad_s * period_s_ * kMissingPeriods))
    return fmt::format("the position jumped by {:.4f} rad to {:.4f} rad in a period: check the encoder",
                       way_rad, position_rad);
  last_position_rad_ = position_rad;
  blind_ = false;
  return std::nullopt;
}

std::optional<std::string> MotionGuard::judge(const ActuatorReading& reading, double speed_rad_s,
                                              bool enabled) {
  if (reading.fault != ActuatorFault::kNone)
    return fmt::format("the drive reports fault {} (error {}): see docs/faults.md",
                       static_cast<int>(reading.fault), reading.drive_error);
  if (std::optional<std::string> wrong = judge_position(reading)) return wrong;
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
  if (reading.has_temperature && reading.temperature_C > limits_.temperature_C)
    return fmt::format("temperature {:.1f} degC is above {:.1f} degC", reading.temperature_C,
                       limits_.temperature_C);
  if (std::abs(speed_rad_s) > limits_.speed_rad_s)
    return fmt::format("speed {:.3f} rad/s at {:.4f} rad is above {:.3f} rad/s", speed_rad_s,
                       reading.joint_position_rad, limits_.speed_rad_s);
  return std::nullopt;
}

}  // namespace strainwave
