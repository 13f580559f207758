// SPDX-License-Identifier: BSD-3-Clause
// Measurements of one period, and the position and velocity that the controller derives from them. Real-time safe. Joint side, SI; positions
// are on the side of the encoder.
#pragma once

#include <cmath>
#include <optional>

namespace strainwave {

/// Largest number of periods between a torque's computation and its effect.
inline constexpr int kMaxControlDelay = 8;
/// After a longer gap between two steps the motion is unknown: the controller continues from the joint's position.
inline constexpr int kMaxElapsedPeriods = 20;

/// One period's measurements.
struct JointMeasurement {
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;  ///< used only when has_velocity
  double temperature_C = 0.0;         ///< used only when temperature_valid
  /// Without a reading the controller assumes that the distance of the joint from its plan has not changed.
  bool has_position = true;
  bool has_velocity = false;
  bool temperature_valid = false;
  /// Periods since the last step(), >= 1; more when the loop skipped some. Over those the last torque stayed applied and the trajectory
  /// advances, unless they are more than kMaxElapsedPeriods.
  int elapsed_periods = 1;
  /// >= 0: by how many periods the position is older than delay_periods assumes. More than kMaxControlDelay count as that many.
  int late_periods = 0;
  /// The torque that a drive with its own loop reports, if it does.
  std::optional<double> drive_torque_Nm;
};

/// Position, and velocity from the differences of readings.
class JointReading {
 public:
  /// `period_s` > 0; `velocity_share` in (0, 1]: share of each difference in the velocity (control/joint/link_velocity.h); `count_rad` > 0.
  JointReading(double period_s, double velocity_share, double count_rad) noexcept
      : period_s_(period_s), share_(velocity_share), count_rad_(count_rad) {}

  void reset(double position_rad, double velocity_rad_s) noexcept {
    position_rad_ = position_rad;
    velocity_rad_s_ = planned_velocity_rad_s_ = velocity_rad_s;
    planned_rad_ = position_rad;
    beside_rad_ = 0.0;
    still_periods_ = 0;
    first_ = true;
  }
  /// The position of reset() was this period's reading: the next reading is a period later.
  void has_been_read() noexcept { first_ = false; }
  /// The plan restarts at `planned_rad`, at rest. The jump does not count as planned velocity.
  void replan(double planned_rad) noexcept { planned_rad_ = planned_rad; }

  /// One period. The plan expects the reading `planned_rad` now, and expected `planned_then_rad` when the position was sampled.
  void step(const JointMeasurement& measurement, double planned_rad, double planned_then_rad) noexcept {
    if (measurement.has_position) beside_rad_ = measurement.joint_position_rad - planned_then_rad;
    const double position_rad = planned_rad + beside_rad_;
    const double moved_rad = position_rad - position_rad_;
    const double passed_s = measurement.elapsed_periods * period_s_;
    // The first reading is the one that reset() received: no time has passed.
    const double shown_rad_s = first_ ? velocity_rad_s_ : moved_rad / passed_s;
    const double planned_rad_s = first_ ? velocity_rad_s_ : (planned_rad - planned_rad_) / passed_s;
    const bool measured = measurement.has_velocity && share_ == 1.0;
    velocity_rad_s_ = measured ? measurement.joint_velocity_rad_s : mixed(velocity_rad_s_, shown_rad_s);
    planned_velocity_rad_s_ = mixed(planned_velocity_rad_s_, planned_rad_s);
    still_periods_ = std::abs(moved_rad) < 0.5 * count_rad_ ? still_periods_ + 1 : 0;
    position_rad_ = position_rad;
    planned_rad_ = planned_rad;
    first_ = false;
  }

  double position_rad() const noexcept { return position_rad_; }
  double velocity_rad_s() const noexcept { return velocity_rad_s_; }
  /// The plan's velocity, filtered like the reading's.
  double planned_velocity_rad_s() const noexcept { return planned_velocity_rad_s_; }
  /// Periods since the reading last changed.
  int still_periods() const noexcept { return still_periods_; }

 private:
  double mixed(double before, double now) const noexcept { return before + share_ * (now - before); }

  double period_s_;
  double share_;
  double count_rad_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  double planned_rad_ = 0.0;
  double planned_velocity_rad_s_ = 0.0;
  double beside_rad_ = 0.0;  ///< reading minus plan
  int still_periods_ = 0;
  bool first_ = true;
};

}  // namespace strainwave
