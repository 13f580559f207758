// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/test_motion.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

constexpr double kLeastFree_rad = 0.1;
constexpr double kSlowTest_rad_s = 0.2;
constexpr double kSlowReach_rad = 0.3;
constexpr double kShort_rad = 0.05;
constexpr double kRest_s = 0.25;

}  // namespace

std::vector<TestStroke> plan_test_motion(const limits_v1& limits, double position_rad, double reach_rad) {
  const double low = std::max(limits.position_min_rad, position_rad - reach_rad);
  const double high = std::min(limits.position_max_rad, position_rad + reach_rad);
  if (!(high - low >= kLeastFree_rad)) return {};
  const double fastest = limits.speed_limit_rad_s;
  const double slow = std::min(kSlowTest_rad_s, 0.5 * fastest);
  const double slow_low = std::max(low, position_rad - kSlowReach_rad);
  const double slow_high = std::min(high, position_rad + kSlowReach_rad);
  std::vector<TestStroke> strokes{{position_rad, slow, 1.0}};
  const auto stroke = [&](double to_rad, double speed_rad_s) {
    strokes.push_back({to_rad, speed_rad_s, kRest_s});
  };
  stroke(slow_low, slow);
  stroke(slow_high, slow);
  stroke(low, 0.25 * fastest);
  stroke(high, 0.25 * fastest);
  for (const double share : {0.6, 1.0, 1.0}) {
    stroke(low, share * fastest);
    stroke(high, share * fastest);
  }
  // Short strokes show delay and stiffness.
  for (int i = 0; i < 4; ++i) {
    stroke(high - kShort_rad, fastest);
    stroke(high, fastest);
  }
  strokes.push_back({position_rad, 0.5 * fastest, 1.0});
  return strokes;
}

double duration_s(const std::vector<TestStroke>& strokes, const limits_v1& limits, double position_rad) {
  double sum = 0.0;
  for (const TestStroke& stroke : strokes) {
    const double way_rad = std::abs(stroke.position_rad - position_rad);
    sum += way_rad / stroke.speed_rad_s + stroke.rest_s +
           std::min(stroke.speed_rad_s, std::sqrt(way_rad * limits.acceleration_rad_s2)) /
               limits.acceleration_rad_s2;
    position_rad = stroke.position_rad;
  }
  return sum;
}

}  // namespace strainwave
