// SPDX-License-Identifier: BSD-3-Clause
// The setpoint of a jogged joint: it approaches a velocity within the acceleration limit, and stops at the
// ends of the range. Time is an argument. Not real-time.
#pragma once

namespace strainwave {

/// Joint side. All > 0, except the positions.
struct JogLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};

class JogMotion {
 public:
  /// Starts at rest at `position_rad`, clamped to the range.
  JogMotion(double position_rad, const JogLimits& limits);

  /// One step of `step_s` >= 0 towards the velocity w, limited by the speed s and the acceleration a:
  ///
  ///   d   distance to the end of the range in the direction of motion
  ///   v'  w within v - a step .. v + a step, |v'| <= s, |v'| <= sqrt(2 a d)
  ///   p'  p + (v + v') / 2 step, within the range
  void step(double wanted_rad_s, double step_s);

  double position_rad() const noexcept { return position_rad_; }
  double velocity_rad_s() const noexcept { return velocity_rad_s_; }

 private:
  JogLimits limits_;
  double position_rad_;
  double velocity_rad_s_ = 0.0;
};

}  // namespace strainwave
