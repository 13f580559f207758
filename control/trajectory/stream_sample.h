// SPDX-License-Identifier: BSD-3-Clause
// What goes into StreamBuffer and what comes out of it. Real-time safe. Joint side, SI.
#pragma once

#include <cstdint>

namespace strainwave {

/// What a sender knows of the load and the joint does not: a torque to add to the planned one, and an inertia that the joint carries
/// besides its own.
struct StreamLoad {
  double torque_Nm = 0.0;
  double inertia_kgm2 = 0.0;  ///< >= 0
};

/// One setpoint of a stream. All finite. Either `in_periods` or `sent_us` is above 0.
struct StreamSample {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;       ///< with derivatives >= 1
  double acceleration_rad_s2 = 0.0;  ///< with derivatives == 2
  int derivatives = 0;               ///< how many of the position's are given: 0, 1 or 2
  std::int64_t in_periods = 0;  ///< from now to the instant that it is for, > 0; 0: it says when it was sent
  StreamLoad load{};
  std::int64_t sent_us = 0;  ///< on the sender's clock, used where in_periods is 0
};

/// What became of a sample.
enum class SampleFate {
  kInTime,
  kLate,                  ///< its instant had passed; the motion is led on by it
  kVelocitiesContradict,  ///< like several before it, its velocity is not that of the positions: the stream is to end
};

/// Target of a period: at its begin and at its end.
struct MovingTarget {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double next_position_rad = 0.0;
  double next_velocity_rad_s = 0.0;
  StreamLoad load{};
  bool rests() const noexcept { return velocity_rad_s == 0.0 && next_velocity_rad_s == 0.0; }
};

}  // namespace strainwave
