// SPDX-License-Identifier: BSD-3-Clause
// The motion by which the doctor tests a joint: slow, fast and short strokes about where it stands. Pure. Not real-time.
#pragma once

#include <strainwave/limits_v1.hpp>
#include <vector>

namespace strainwave {

/// To `position_rad` at this speed, then rest.
struct TestStroke {
  double position_rad = 0.0;
  double speed_rad_s = 0.0;
  double rest_s = 0.0;
};

/// Within the joint's limits and `reach_rad` > 0 to either side of `position_rad`, and back there at the end. Empty: fewer than 0.1 rad are free.
std::vector<TestStroke> plan_test_motion(const limits_v1& limits, double position_rad, double reach_rad);

/// Expected, s.
double duration_s(const std::vector<TestStroke>& strokes, const limits_v1& limits, double position_rad);

}  // namespace strainwave
