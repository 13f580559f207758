// SPDX-License-Identifier: BSD-3-Clause
// Input and output of StreamBuffer. Real-time safe. Joint side, SI.
#pragma once

#include <cstdint>

namespace strainwave {

/// Load that the sender knows and the joint does not: a torque to add to the planned one, and an inertia to add to the joint's.
struct StreamLoad {
  double torque_Nm = 0.0;
  double inertia_kgm2 = 0.0;  ///< >= 0
};

/// One setpoint of a stream. All finite. Either `in_periods` or `sent_us` is above 0.
struct StreamSample {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;       ///< with derivatives >= 1
  double acceleration_rad_s2 = 0.0;  ///< with derivatives == 2
  int derivatives = 0;               ///< number of derivatives given: 0, 1 or 2
  std::int64_t in_periods = 0;       ///< from now to its instant, > 0; 0: the sample has sent_us
  StreamLoad load{};
  std::int64_t sent_us = 0;  ///< on the sender's clock, used where in_periods is 0
};

/// Result of taking a sample.
enum class SampleFate {
  kInTime,
  kLate,                  ///< its instant had passed; the motion still uses it
  kVelocitiesContradict,  ///< its velocity contradicts the positions, like several before: the stream is to end
};

/// Target of a period: at its beginning and at its end.
struct MovingTarget {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double next_position_rad = 0.0;
  double next_velocity_rad_s = 0.0;
  StreamLoad load{};
  bool rests() const noexcept { return velocity_rad_s == 0.0 && next_velocity_rad_s == 0.0; }
};

}  // namespace strainwave
