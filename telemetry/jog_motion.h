// SPDX-License-Identifier: BSD-3-Clause
// Where a jogged joint shall be: a velocity that is reached within the acceleration, and that ends at the ends of the range. Time is an
// argument. Not real-time.
#pragma once

namespace strainwave {

/// Joint side, all above 0 but the positions.
struct JogLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};

class JogMotion {
 public:
  /// From rest at `position_rad`, or at the nearer end of the range beyond it.
  JogMotion(double position_rad, const JogLimits& limits);

  /// One step of `step_s` >= 0 towards the velocity w, of which more than the speed s is not reached:
  ///
  ///   d   way to the end of the range in the direction of motion
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
