// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/smooth_path.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// The largest acceleration of a minimum-jerk motion over distance D in time T is 10 / sqrt(3) D / T^2. For a
// change of velocity by U it is 3/2 U / T.
const double kMovePeak = 10.0 / std::sqrt(3.0);
constexpr double kChangePeak = 1.5;

}  // namespace

void SmoothPath::go(double position_rad, double velocity_rad_s, double duration_s) {
  knots_.push_back({end_s() + duration_s, position_rad, velocity_rad_s});
}

void SmoothPath::go_on(double duration_s) {
  const Knot& last = knots_.back();
  go(last.position_rad + duration_s * last.velocity_rad_s, last.velocity_rad_s, duration_s);
}

void SmoothPath::move_to(double position_rad, double acceleration_rad_s2) {
  const double distance_rad = std::abs(position_rad - knots_.back().position_rad);
  go(position_rad, 0.0, std::sqrt(kMovePeak * distance_rad / acceleration_rad_s2));
}

void SmoothPath::change_velocity(double velocity_rad_s, double acceleration_rad_s2) {
  const Knot& last = knots_.back();
  const double duration_s =
      kChangePeak * std::abs(velocity_rad_s - last.velocity_rad_s) / acceleration_rad_s2;
  go(last.position_rad + 0.5 * duration_s * (velocity_rad_s + last.velocity_rad_s), velocity_rad_s,
     duration_s);
}

Reference SmoothPath::at(double time_s) const noexcept {
  if (time_s <= knots_.front().time_s) return {knots_.front().position_rad, 0.0, 0.0};
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time_s,
                                      [](double time, const Knot& knot) { return time < knot.time_s; });
  if (after == knots_.end()) return {knots_.back().position_rad, knots_.back().velocity_rad_s, 0.0};
  const Knot& from = *(after - 1);
  const double T = after->time_s - from.time_s;
  const double s = (time_s - from.time_s) / T;
  const double D = after->position_rad - from.position_rad - from.velocity_rad_s * T;
  const double U = (after->velocity_rad_s - from.velocity_rad_s) * T;
  const double a3 = 10.0 * D - 4.0 * U;
  const double a4 = 7.0 * U - 15.0 * D;
  const double a5 = 6.0 * D - 3.0 * U;
  const double cube = s * s * s;
  return {from.position_rad + from.velocity_rad_s * T * s + cube * (a3 + s * (a4 + s * a5)),
          from.velocity_rad_s + s * s * (3.0 * a3 + s * (4.0 * a4 + s * 5.0 * a5)) / T,
          s * (6.0 * a3 + s * (12.0 * a4 + s * 20.0 * a5)) / (T * T)};
}

}  // namespace strainwave
