// What goes into StreamTarget and what comes out of it. Real-time safe. Joint side, SI.
#pragma once

#include <cstdint>

namespace strainwave {

/// What who streams knows of the load and the joint does not: a torque to add to the planned one, and an inertia that is carried
/// besides the joint's own.
struct ToldLoad {
  double torque_Nm = 0.0;
  double inertia_kgm2 = 0.0;  ///< >= 0
};

/// One setpoint of a stream. All finite.
struct StreamSample {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;       ///< with derivatives >= 1
  double acceleration_rad_s2 = 0.0;  ///< with derivatives == 2
  int derivatives = 0;               ///< how many of the position's are given: 0, 1 or 2
  /// Periods from now to the instant that it is for, > 0; 0: none is given.
  std::int64_t in_periods = 0;
  ToldLoad load{};
  std::int64_t sent_us = 0;  ///< when it was sent, on the sender's clock; 0: not told
  /// Its derivatives are those of its positions, whatever the samples around it show.
  bool computed_here = false;
};

/// Target of a period: at its begin and at its end.
struct MovingTarget {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double next_position_rad = 0.0;
  double next_velocity_rad_s = 0.0;
  ToldLoad load{};
  bool rests() const noexcept { return velocity_rad_s == 0.0 && next_velocity_rad_s == 0.0; }
};

}  // namespace strainwave
