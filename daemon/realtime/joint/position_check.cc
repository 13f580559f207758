// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/position_check.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace strainwave {

namespace {

/// Assumed count of a sensor with finer counts or none.
constexpr double kFinestCount_rad = 1e-5;
/// Margins for a working sensor: quantisation at both ends, and sampling that is not exactly periodic.
constexpr double kJumpFactor = 2.0;
constexpr double kJumpCounts = 4.0;
/// A joint may have more friction than its table says.
constexpr double kFrictionFactor = 1.5;
/// Expected motion, in counts, above which an unchanged sensor is stuck.
constexpr double kStuckCounts = 10.0;
/// After its last change the joint may still be coming to rest under another torque.
constexpr int kSettlingPeriods = 5;

}  // namespace

PositionCheck::PositionCheck(const JointLoopConfig& config) noexcept
    : period_s_(config.controller.period_s),
      overspeed_rad_s_(config.limits.overspeed_rad_s),
      count_rad_(std::max(config.controller.encoder_resolution_rad, kFinestCount_rad)) {}

bool PositionCheck::plausible(double position_rad, double torque_Nm, bool driven,
                              std::int64_t now_ns) noexcept {
  const bool jump = driven && has_last_ && jumped(position_rad, elapsed_s(now_ns));
  if (!driven || !has_last_) begin_stretch();
  const bool motionless = driven && has_last_ && stuck(position_rad, torque_Nm, elapsed_s(now_ns));
  doubt_ = jump         ? doubt_number(ReadingDoubt::kJump, std::abs(position_rad - last_position_rad_))
           : motionless ? doubt_number(ReadingDoubt::kStuck, std::abs(owed_motion_rad_))
                        : 0;
  last_position_rad_ = position_rad;
  last_ns_ = now_ns;
  has_last_ = true;
  return doubt_ == 0;
}

double PositionCheck::elapsed_s(std::int64_t now_ns) const noexcept {
  return std::max(period_s_, seconds(now_ns - last_ns_));
}

bool PositionCheck::jumped(double position_rad, double elapsed_s) const noexcept {
  const double allowed_rad = kJumpFactor * overspeed_rad_s_ * elapsed_s + kJumpCounts * count_rad_;
  return std::abs(position_rad - last_position_rad_) > allowed_rad;
}

void PositionCheck::begin_stretch() noexcept {
  unchanged_periods_ = 0;
  owed_velocity_rad_s_ = 0.0;
  owed_motion_rad_ = 0.0;
}

bool PositionCheck::stuck(double position_rad, double torque_Nm, double elapsed_s) noexcept {
  if (position_rad != last_position_rad_) {
    begin_stretch();
    return false;
  }
  unchanged_periods_ = std::min(unchanged_periods_ + 1, kSettlingPeriods + 1);
  if (unchanged_periods_ <= kSettlingPeriods) {
    rest_torque_Nm_ = torque_Nm;
    return false;
  }
  const double change_Nm = torque_Nm - rest_torque_Nm_;
  const double excess_Nm = std::abs(change_Nm) - 2.0 * kFrictionFactor * static_friction_Nm_;
  if (excess_Nm <= 0.0) {
    owed_velocity_rad_s_ = 0.0;  // it may have come to rest again
    return false;
  }
  owed_velocity_rad_s_ += std::copysign(excess_Nm, change_Nm) / inertia_kgm2_ * elapsed_s;
  owed_motion_rad_ += owed_velocity_rad_s_ * elapsed_s;
  return std::abs(owed_motion_rad_) > kStuckCounts * count_rad_;
}

}  // namespace strainwave
