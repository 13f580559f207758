// SPDX-License-Identifier: BSD-3-Clause
// A motion that a program plans beforehand, of quintic polynomials without acceleration at the knots. Offline; at()
// is real-time safe. Joint side, SI. Source: Flash and Hogan (1985), the minimum-jerk polynomial.
//
//   s = (t - t0) / T,  T = t1 - t0,  D = p1 - p0 - v0 T,  U = (v1 - v0) T
//   p = p0 + v0 T s + (10 D - 4 U) s^3 + (7 U - 15 D) s^4 + (6 D - 3 U) s^5
#pragma once

#include <vector>

#include "control/trajectory/reference_shaper.h"

namespace strainwave {

class SmoothPath {
 public:
  /// Rests at 0 rad until `begin_s`, >= 0.
  explicit SmoothPath(double begin_s) { knots_.push_back({begin_s, 0.0, 0.0}); }

  /// Goes to `position_rad` at `velocity_rad_s`, `duration_s` > 0 later.
  void go(double position_rad, double velocity_rad_s, double duration_s);
  /// Keeps the velocity for `duration_s` > 0.
  void go_on(double duration_s);
  /// Goes from rest to rest at `position_rad`, with an acceleration of at most `acceleration_rad_s2` > 0.
  void move_to(double position_rad, double acceleration_rad_s2);
  /// Changes to another velocity with the same limit.
  void change_velocity(double velocity_rad_s, double acceleration_rad_s2);

  /// Position, velocity and acceleration at `time_s`.
  Reference at(double time_s) const noexcept;
  double end_s() const noexcept { return knots_.back().time_s; }

 private:
  struct Knot {
    double time_s, position_rad, velocity_rad_s;
  };
  std::vector<Knot> knots_;
};

}  // namespace strainwave
