// SPDX-License-Identifier: BSD-3-Clause
// Finds the spans of a trace in which the motor slides in one direction. Not real-time.
#pragma once

#include <vector>

#include "commission/joint_trace.h"

namespace strainwave {

struct MotionSpan {
  std::size_t first = 0;
  std::size_t count = 0;
  double direction = 1.0;  ///< +1 or -1
};

/// Speed of the motor in rad/s around `sample`, over 8 periods; the encoder's resolution adds up to a quarter of a count per period.
double speed_around(const JointTrace& trace, std::size_t sample);

/// Speed above which a motor with a gear of ratio N is beyond the Stribeck curve: twice its 20 RPM at the motor (data/README.md).
double sliding_speed_rad_s(double gear_ratio);

/// Stretches of at least `least` samples in which the motor is faster than the sliding speed throughout.
std::vector<MotionSpan> sliding_spans(const JointTrace& trace, double gear_ratio, std::size_t least);

}  // namespace strainwave
