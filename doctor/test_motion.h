// SPDX-License-Identifier: BSD-3-Clause
// The doctor's test motion: slow, fast and short strokes around the joint's position. Pure. Not real-time.
#pragma once

#include <strainwave/limits_v1.hpp>
#include <vector>

namespace strainwave {

/// A motion to `position_rad` at this speed, then a rest.
struct TestStroke {
  double position_rad = 0.0;
  double speed_rad_s = 0.0;
  double rest_s = 0.0;
};

/// Plans strokes within the limits and `reach_rad` > 0 to either side of `position_rad`, where they end. Empty if less than 0.1 rad is free.
std::vector<TestStroke> plan_test_motion(const limits_v1& limits, double position_rad, double reach_rad);

/// Expected duration of the strokes from `position_rad`.
double duration_s(const std::vector<TestStroke>& strokes, const limits_v1& limits, double position_rad);

}  // namespace strainwave
