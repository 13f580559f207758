// SPDX-License-Identifier: BSD-3-Clause
#include "tests/daemon/realtime/path/random_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave::testing {

namespace {

// Knots are at least so far apart: two periods of the daemon.
constexpr double kLeastApart_s = 2e-3;
constexpr std::size_t kMostKnots = 300;
/// What somebody reads who teaches a point by hand.
constexpr double kTaught_rad = 1e-4;
/// How often somebody leaves one of several joints where it is.
constexpr double kStays = 0.15;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
/// As likely in every decade.
double decades(std::mt19937_64& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}
std::size_t count_between(std::mt19937_64& random, std::size_t low, std::size_t high) {
  return static_cast<std::size_t>(
      std::lround(decades(random, static_cast<double>(low), static_cast<double>(high))));
}

using Times = std::vector<double>;

Times uneven_times(std::mt19937_64& random, std::size_t count, double unevenness) {
  Times times(count);
  for (std::size_t i = 1; i < count; ++i)
    times[i] = times[i - 1] + between(random, 1.0 - unevenness, 1.0 + unevenness);
  return times;
}

/// Velocities with which the acceleration has no step at inner knots: the spline that is at rest at both ends.
///   v_i-1 / h_i-1 + 2 v_i (1 / h_i-1 + 1 / h_i) + v_i+1 / h_i = 3 (d_i-1 / h_i-1 + d_i / h_i)
void give_spline_velocities(DrawnPart& part) {
  const std::size_t count = part.size();
  std::vector<double> above(count), right(count);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before_s = part[i].time_s - part[i - 1].time_s;
    const double after_s = part[i + 1].time_s - part[i].time_s;
    const double before_rad_s = (part[i].position_rad - part[i - 1].position_rad) / before_s;
    const double after_rad_s = (part[i + 1].position_rad - part[i].position_rad) / after_s;
    const double pivot = 2.0 * (1.0 / before_s + 1.0 / after_s) - above[i - 1] / before_s;
    above[i] = 1.0 / after_s / pivot;
    right[i] = (3.0 * (before_rad_s / before_s + after_rad_s / after_s) - right[i - 1] / before_s) / pivot;
  }
  part.back().velocity_rad_s = 0.0;
  for (std::size_t i = count - 1; i-- > 1;)
    part[i].velocity_rad_s = right[i] - above[i] * part[i + 1].velocity_rad_s;
  part.front().velocity_rad_s = 0.0;
}

DrawnPart spline_through_points(std::mt19937_64& random, const Times& times, double reach_rad) {
  DrawnPart part;
  double position_rad = 0.0;
  for (const double time_s : times) {
    if (!part.empty() && between(random, 0.0, 1.0) > kStays)
      position_rad = between(random, -reach_rad, reach_rad);
    part.push_back({time_s, position_rad, 0.0});
  }
  give_spline_velocities(part);
  return part;
}

/// The same motion in knots at `times`, of which the last is its end.
DrawnPart resampled(const DrawnPart& part, const Times& times) {
  DrawnPart result;
  for (const double time : times) {
    const double time_s = time / times.back() * part.back().time_s;
    const DrawnPoint point = evaluate(part, time_s);
    result.push_back({time_s, point.position_rad, point.velocity_rad_s});
  }
  result.front().velocity_rad_s = result.back().velocity_rad_s = 0.0;
  return result;
}

DrawnPart taught_by_hand(std::mt19937_64& random, const Times& times, double reach_rad) {
  constexpr int kWaves = 3;
  double size_rad[kWaves], turns[kWaves], phase[kWaves];
  for (int i = 0; i < kWaves; ++i) {
    size_rad[i] = between(random, 0.0, reach_rad / kWaves);
    turns[i] = between(random, 0.2, 3.0);
    phase[i] = between(random, 0.0, 2.0 * std::numbers::pi);
  }
  DrawnPart part;
  for (const double time_s : times) {
    const double u = time_s / times.back();
    const double in = std::min(1.0, 8.0 * u);
    double position_rad = 0.0;
    for (int i = 0; i < kWaves; ++i)
      position_rad += size_rad[i] * std::sin(2.0 * std::numbers::pi * turns[i] * u + phase[i]);
    position_rad *= in * in * (3.0 - 2.0 * in);
    part.push_back({time_s, kTaught_rad * std::round(position_rad / kTaught_rad), 0.0});
  }
  give_spline_velocities(part);
  return part;
}

/// From rest to rest, so often, in one knot for each of `times`.
DrawnPart quintics(std::mt19937_64& random, const Times& times, std::size_t ways, double reach_rad) {
  std::vector<double> places_rad{0.0};
  while (places_rad.size() <= ways) places_rad.push_back(between(random, -reach_rad, reach_rad));
  const double way_s = times.back() / static_cast<double>(ways);
  DrawnPart part;
  for (const double time_s : times) {
    const std::size_t way = std::min(ways - 1, static_cast<std::size_t>(time_s / way_s));
    const double u = time_s / way_s - static_cast<double>(way);
    const double far_rad = places_rad[way + 1] - places_rad[way];
    part.push_back({time_s, places_rad[way] + far_rad * u * u * u * (10.0 + u * (6.0 * u - 15.0)),
                    far_rad * 30.0 * u * u * (1.0 - u) * (1.0 - u) / way_s});
  }
  part.front().velocity_rad_s = part.back().velocity_rad_s = 0.0;
  return part;
}

DrawnPath draw_shape(std::mt19937_64& random, std::size_t joints) {
  DrawnPath path;
  const double reach_rad = decades(random, 0.02, 1.2);
  const Times few = uneven_times(random, count_between(random, 2, 16), 0.5);
  const Times many = uneven_times(random, count_between(random, 17, kMostKnots), 0.3);
  const Times some = uneven_times(random, count_between(random, 2, kMostKnots), 0.0);
  const std::size_t ways = some.size() < 8 ? 1 : count_between(random, 1, 4);
  const auto kind = std::uniform_int_distribution<std::size_t>(0, 3)(random);
  path.kind = std::vector<std::string>{"spline", "spline in many knots", "taught", "quintic"}[kind];
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (kind == 0) path.parts.push_back(spline_through_points(random, few, reach_rad));
    if (kind == 1) path.parts.push_back(resampled(spline_through_points(random, few, reach_rad), many));
    if (kind == 2) path.parts.push_back(taught_by_hand(random, many, reach_rad));
    if (kind == 3) path.parts.push_back(quintics(random, some, ways, reach_rad));
  }
  return path;
}

struct Largest {
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};

Largest largest_of(const DrawnPath& path) {
  Largest largest;
  for (const DrawnPart& part : path.parts)
    for (std::size_t i = 0; i + 1 < part.size(); ++i) {
      const auto [begin_rad_s2, end_rad_s2] = end_accelerations(part, i);
      largest.acceleration_rad_s2 =
          std::max({largest.acceleration_rad_s2, std::abs(begin_rad_s2), std::abs(end_rad_s2)});
      const double apart_s = part[i + 1].time_s - part[i].time_s;
      for (int k = 0; k < 32; ++k)
        largest.speed_rad_s =
            std::max(largest.speed_rad_s,
                     std::abs(evaluate(part, part[i].time_s + k / 32.0 * apart_s).velocity_rad_s));
    }
  return largest;
}

void stretch(DrawnPath& path, double in_time, double in_size) {
  for (DrawnPart& part : path.parts)
    for (DrawnKnot& knot : part) {
      knot.time_s *= in_time;
      knot.position_rad *= in_size;
      knot.velocity_rad_s *= in_size / in_time;
    }
}

double least_apart_s(const DrawnPart& part) {
  double least_s = part.back().time_s;
  for (std::size_t i = 0; i + 1 < part.size(); ++i)
    least_s = std::min(least_s, part[i + 1].time_s - part[i].time_s);
  return least_s;
}

std::string named(std::size_t knot) {
  return "knot " + std::to_string(knot) + " (";
}

}  // namespace

DrawnPath draw_path(std::mt19937_64& random, std::size_t joints, const DrawnWithin& within) {
  DrawnPath path = draw_shape(random, joints);
  // All joints may have been left where they are.
  while (largest_of(path).speed_rad_s == 0.0) path = draw_shape(random, joints);
  const Largest shape = largest_of(path);
  const double speed_rad_s = within.speed_rad_s * between(random, 0.2, 1.0);
  const double acceleration_rad_s2 = within.acceleration_rad_s2 * between(random, 0.2, 1.0);
  stretch(
      path,
      std::max(shape.speed_rad_s / speed_rad_s, std::sqrt(shape.acceleration_rad_s2 / acceleration_rad_s2)),
      1.0);
  // One that would take too long goes less far, as fast.
  if (const double less = within.duration_s / path.duration_s(); less < 1.0) stretch(path, less, less * less);
  if (const double apart_s = least_apart_s(path.parts.front()); apart_s < kLeastApart_s)
    stretch(path, kLeastApart_s / apart_s, 1.0);
  return path;
}

DrawnPoint evaluate(const DrawnPart& part, double time_s) {
  if (time_s < 0.0) return {part.front().position_rad, 0.0, 0.0};
  const auto next = std::upper_bound(part.begin(), part.end(), time_s,
                                     [](double t, const DrawnKnot& knot) { return t < knot.time_s; });
  if (next == part.end()) return {part.back().position_rad, 0.0, 0.0};
  const DrawnKnot& from = *(next - 1);
  const double h = next->time_s - from.time_s;
  const double u = (time_s - from.time_s) / h;
  const double p0 = from.position_rad, p1 = next->position_rad;
  const double m0 = h * from.velocity_rad_s, m1 = h * next->velocity_rad_s;
  return {(1 + 2 * u) * (1 - u) * (1 - u) * p0 + u * (1 - u) * (1 - u) * m0 + u * u * (3 - 2 * u) * p1 +
              u * u * (u - 1) * m1,
          (6 * u * (u - 1) * (p0 - p1) + (1 - u) * (1 - 3 * u) * m0 + u * (3 * u - 2) * m1) / h,
          ((12 * u - 6) * (p0 - p1) + (6 * u - 4) * m0 + (6 * u - 2) * m1) / (h * h)};
}

EndAccelerations end_accelerations(const DrawnPart& part, std::size_t knot) {
  const DrawnKnot& from = part[knot];
  const DrawnKnot& to = part[knot + 1];
  const double h = to.time_s - from.time_s;
  const double far_rad = to.position_rad - from.position_rad;
  return {(6 * far_rad - h * (4 * from.velocity_rad_s + 2 * to.velocity_rad_s)) / (h * h),
          (-6 * far_rad + h * (2 * from.velocity_rad_s + 4 * to.velocity_rad_s)) / (h * h)};
}

Infeasible too_fast(std::mt19937_64& random, DrawnPart part, double speed_rad_s) {
  const std::size_t knot = std::uniform_int_distribution<std::size_t>(1, part.size() - 2)(random);
  part[knot].velocity_rad_s = std::copysign(1.2 * speed_rad_s, part[knot].velocity_rad_s);
  return {part, named(knot), "joint.limits.speed_limit_rad_s"};
}

Infeasible too_short(DrawnPart part, double acceleration_rad_s2, double period_s) {
  std::size_t knot = 0;
  for (std::size_t i = 1; i + 1 < part.size(); ++i)
    if (std::abs(part[i + 1].position_rad - part[i].position_rad) >
        std::abs(part[knot + 1].position_rad - part[knot].position_rad))
      knot = i;
  const double enough_rad_s2 = 1.1 * acceleration_rad_s2;
  for (;;) {
    const double apart_s = part[knot + 1].time_s - part[knot].time_s;
    const auto [begin_rad_s2, end_rad_s2] = end_accelerations(part, knot);
    if (apart_s < period_s) return {part, named(knot + 1), "a period after the knot before"};
    if (std::abs(begin_rad_s2) > enough_rad_s2)
      return {part, named(knot),
              begin_rad_s2 * part[knot].velocity_rad_s >= 0.0 ? "joint.limits.acceleration_rad_s2"
                                                              : "joint.limits.deceleration_rad_s2"};
    if (std::abs(begin_rad_s2) < acceleration_rad_s2 && std::abs(end_rad_s2) > enough_rad_s2)
      return {part, named(knot),
              end_rad_s2 * part[knot + 1].velocity_rad_s > 0.0 ? "joint.limits.acceleration_rad_s2"
                                                               : "joint.limits.deceleration_rad_s2"};
    for (std::size_t later = knot + 1; later < part.size(); ++later) part[later].time_s -= 0.02 * apart_s;
  }
}

}  // namespace strainwave::testing
