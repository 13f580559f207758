// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/knot_path.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/printable.h"

namespace strainwave {

namespace {

// Knots are computed numbers: a knot at a limit may exceed it by rounding.
constexpr double kRounding = 1.0 + kAtBound;

/// One cubic.
struct Segment {
  double duration_s = 0.0;
  PathKnot from;
  double acceleration_rad_s2 = 0.0;  ///< at its begin
  double jerk_rad_s3 = 0.0;

  Reference at(double since_s) const noexcept {
    return {from.position_rad + since_s * (from.velocity_rad_s + since_s * (0.5 * acceleration_rad_s2 +
                                                                            since_s * jerk_rad_s3 / 6.0)),
            from.velocity_rad_s + since_s * (acceleration_rad_s2 + 0.5 * since_s * jerk_rad_s3),
            acceleration_rad_s2 + since_s * jerk_rad_s3};
  }
};

Segment segment_between(const PathKnot& from, const PathKnot& to) noexcept {
  const double T = to.time_s - from.time_s;
  const double mean_rad_s = (to.position_rad - from.position_rad) / T;
  return {T, from, (6.0 * mean_rad_s - 4.0 * from.velocity_rad_s - 2.0 * to.velocity_rad_s) / T,
          6.0 * (from.velocity_rad_s + to.velocity_rad_s - 2.0 * mean_rad_s) / (T * T)};
}

// Times of reversals: v0 + a0 u + j u^2 / 2 = 0, in the form that loses no digits. Not finite without a reversal.
std::array<double, 2> turns_of(const Segment& segment) noexcept {
  const double a = segment.acceleration_rad_s2;
  const double j = segment.jerk_rad_s3;
  const double v = segment.from.velocity_rad_s;
  const double q = -(a + std::copysign(std::sqrt(a * a - 2.0 * j * v), a));
  return {q / j, 2.0 * v / q};
}

using Found = std::optional<std::string>;

/// Checks one place of a path against each limit.
class Judge {
 public:
  Judge(const PathLimits& limits, std::size_t knot) : limits_(limits), knot_(knot) {}

  /// `number`: label of `value`, such as "time_s = "; `bound`: the limit that `value` exceeds.
  std::string defect(double time_s, const char* number, double value, double bound,
                     const std::string& allowed) const {
    std::ostringstream text;
    text << "knot " << knot_;
    if (std::isfinite(time_s)) text << " (at " << time_s << " s)";
    text << ": " << number << beyond_text(value, bound) << ": " << allowed;
    return text.str();
  }
  Found position(double position_rad, double time_s) const {
    const PositionRange& range = limits_.range;
    if (position_rad < range.min_rad - kAtBound)
      return defect(time_s, "position_rad = ", position_rad, range.min_rad,
                    "at least " + bound_text(range.min_rad) + " is allowed (joint.limits.position_min_rad)");
    if (position_rad <= range.max_rad + kAtBound) return std::nullopt;
    return defect(time_s, "position_rad = ", position_rad, range.max_rad,
                  at_most(range.max_rad, "position_max_rad"));
  }
  Found speed(double velocity_rad_s, double time_s) const {
    return above("speed in rad/s = ", std::abs(velocity_rad_s), limits_.motion.velocity_rad_s,
                 "speed_limit_rad_s", time_s);
  }
  /// `growing`, `falling`: whether the speed grows or falls next to this instant.
  Found acceleration(double acceleration_rad_s2, bool growing, bool falling, double time_s) const {
    const double size_rad_s2 = std::abs(acceleration_rad_s2);
    const MotionLimits& motion = limits_.motion;
    Found found = above("torque of the inertia alone in N.m = ", limits_.inertia_kgm2 * size_rad_s2,
                        limits_.torque_Nm, "torque_limit_Nm", time_s);
    if (!found && growing)
      found = above("acceleration in rad/s^2 = ", size_rad_s2, motion.acceleration_rad_s2,
                    "acceleration_rad_s2", time_s);
    if (!found && falling)
      found = above("deceleration in rad/s^2 = ", size_rad_s2, motion.deceleration_rad_s2,
                    "deceleration_rad_s2", time_s);
    return found;
  }

 private:
  static std::string at_most(double bound, const std::string& key) {
    return "at most " + bound_text(bound) + " is allowed (joint.limits." + key + ")";
  }
  Found above(const char* number, double value, double bound, const std::string& key, double time_s) const {
    if (value <= bound * kRounding) return std::nullopt;
    return defect(time_s, number, value, bound, at_most(bound, key));
  }
  const PathLimits& limits_;
  std::size_t knot_;
};

// At rest the speed grows after the beginning of a segment, and falls before its end.
Found judge_ends(const Segment& segment, const Judge& judge) {
  for (const bool begins : {true, false}) {
    const double since_s = begins ? 0.0 : segment.duration_s;
    const Reference end = segment.at(since_s);
    const bool rests = std::abs(end.velocity_rad_s) <= kAtBound;
    const double by = end.velocity_rad_s * end.acceleration_rad_s2;
    if (auto found = judge.acceleration(end.acceleration_rad_s2, rests ? begins : by > 0.0,
                                        rests ? !begins : by < 0.0, segment.from.time_s + since_s))
      return found;
  }
  return std::nullopt;
}

Found judge_inside(const Segment& segment, const Judge& judge) {
  const auto inside = [&](double since_s) {
    return since_s > kAtBound * segment.duration_s && since_s < (1.0 - kAtBound) * segment.duration_s;
  };
  for (const double since_s : turns_of(segment)) {
    if (!inside(since_s)) continue;
    const Reference turn = segment.at(since_s);
    const double time_s = segment.from.time_s + since_s;
    if (auto found = judge.position(turn.position_rad, time_s)) return found;
    if (auto found = judge.acceleration(turn.acceleration_rad_s2, true, true, time_s)) return found;
  }
  const double fastest_s = -segment.acceleration_rad_s2 / segment.jerk_rad_s3;
  if (!inside(fastest_s)) return std::nullopt;
  return judge.speed(segment.at(fastest_s).velocity_rad_s, segment.from.time_s + fastest_s);
}

Found find_number_defect(const KnotPath& path, std::size_t knot, const PathLimits& limits) {
  const PathKnot& here = path.knots[knot];
  const Judge judge(limits, knot);
  for (const auto& [name, number] :
       {std::pair{"time_s = ", here.time_s}, std::pair{"position_rad = ", here.position_rad},
        std::pair{"velocity_rad_s = ", here.velocity_rad_s}})
    if (!std::isfinite(number))
      return judge.defect(here.time_s, name, number, 0.0, "a finite number is allowed");
  if (knot == 0 && here.time_s != 0.0)
    return judge.defect(here.time_s, "time_s = ", here.time_s, 0.0,
                        "0 is allowed, the first knot begins the path");
  const double earliest_s = knot == 0 ? 0.0 : path.knots[knot - 1].time_s + limits.period_s;
  // Paths are written in decimals: a knot one period later may miss that by rounding.
  if (here.time_s * kRounding < earliest_s)
    return judge.defect(here.time_s, "time_s = ", here.time_s, earliest_s,
                        "at least " + bound_text(earliest_s) + " is allowed, a period after the knot before");
  if (here.time_s > kLongestPath_s)
    return judge.defect(here.time_s, "time_s = ", here.time_s, kLongestPath_s,
                        "at most " + bound_text(kLongestPath_s) + " is allowed");
  const bool end = knot == 0 || knot + 1 == path.count;
  if (end && std::abs(here.velocity_rad_s) > kAtBound)
    return judge.defect(here.time_s, "velocity_rad_s = ", here.velocity_rad_s, 0.0,
                        "0 is allowed, a path begins and ends at rest");
  return std::nullopt;
}

}  // namespace

Reference on_cubic(const PathKnot& from, const PathKnot& to, double time_s) noexcept {
  return segment_between(from, to).at(time_s - from.time_s);
}

Reference PathReader::at(const KnotPath& path, double time_s) noexcept {
  while (segment_ + 1 < path.count && time_s >= path.knots[segment_ + 1].time_s) ++segment_;
  if (segment_ + 1 >= path.count) return {path.last().position_rad, 0.0, 0.0};
  const PathKnot& from = path.knots[segment_];
  return segment_between(from, path.knots[segment_ + 1]).at(std::max(0.0, time_s - from.time_s));
}

std::optional<std::string> find_defect(const KnotPath& path, const PathLimits& limits) {
  if (path.count < 2 || path.count > KnotPath::kMostKnots)
    return "knot_count = " + std::to_string(static_cast<std::int64_t>(path.count)) + ": from 2 to " +
           std::to_string(KnotPath::kMostKnots) + " are allowed";
  for (std::size_t knot = 0; knot < path.count; ++knot)
    if (auto found = find_number_defect(path, knot, limits)) return found;
  // Positions are checked before speeds: a path in degrees is refused for its positions.
  for (std::size_t knot = 0; knot < path.count; ++knot) {
    const PathKnot& here = path.knots[knot];
    if (auto found = Judge(limits, knot).position(here.position_rad, here.time_s)) return found;
  }
  // Speeds are checked before segments: an acceleration between impossible speeds may not be finite.
  for (std::size_t knot = 0; knot < path.count; ++knot) {
    const PathKnot& here = path.knots[knot];
    if (auto found = Judge(limits, knot).speed(here.velocity_rad_s, here.time_s)) return found;
  }
  for (std::size_t knot = 0; knot + 1 < path.count; ++knot) {
    const Judge judge(limits, knot);
    const Segment segment = segment_between(path.knots[knot], path.knots[knot + 1]);
    if (auto found = judge_ends(segment, judge)) return found;
    if (auto found = judge_inside(segment, judge)) return found;
  }
  return std::nullopt;
}

}  // namespace strainwave
