// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/knot_path.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/printable.h"

namespace strainwave {

namespace {

// Knots are computed: one that is at a limit is not beyond it for its last bits.
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

// Where it turns round: v0 + a0 u + j u^2 / 2 = 0, in the form that loses no digits. Not finite where it does not.
std::array<double, 2> turns_of(const Segment& segment) noexcept {
  const double a = segment.acceleration_rad_s2;
  const double j = segment.jerk_rad_s3;
  const double v = segment.from.velocity_rad_s;
  const double q = -(a + std::copysign(std::sqrt(a * a - 2.0 * j * v), a));
  return {q / j, 2.0 * v / q};
}

using Found = std::optional<PathDefect>;

/// The limits, one by one, at one place of a path.
class Judge {
 public:
  Judge(const PathLimits& limits, std::size_t knot) : limits_(limits), knot_(knot) {}

  Found position(double position_rad, double time_s) const {
    const PositionRange& range = limits_.range;
    if (position_rad >= range.min_rad - kAtBound && position_rad <= range.max_rad + kAtBound)
      return std::nullopt;
    return PathDefect{PathDefect::Kind::kPosition, knot_, time_s, position_rad,
                      position_rad < range.min_rad ? range.min_rad : range.max_rad};
  }
  Found speed(double velocity_rad_s, double time_s) const {
    return above(PathDefect::Kind::kSpeed, std::abs(velocity_rad_s), limits_.motion.velocity_rad_s, time_s);
  }
  /// `growing`, `falling`: what the speed does beside this instant.
  Found acceleration(double acceleration_rad_s2, bool growing, bool falling, double time_s) const {
    const double size_rad_s2 = std::abs(acceleration_rad_s2);
    if (auto found =
            above(PathDefect::Kind::kTorque, limits_.inertia_kgm2 * size_rad_s2, limits_.torque_Nm, time_s))
      return found;
    const MotionLimits& motion = limits_.motion;
    if (growing)
      if (auto found =
              above(PathDefect::Kind::kAcceleration, size_rad_s2, motion.acceleration_rad_s2, time_s))
        return found;
    if (!falling) return std::nullopt;
    return above(PathDefect::Kind::kDeceleration, size_rad_s2, motion.deceleration_rad_s2, time_s);
  }

 private:
  Found above(PathDefect::Kind kind, double value, double bound, double time_s) const {
    if (value <= bound * kRounding) return std::nullopt;
    return PathDefect{kind, knot_, time_s, value, bound};
  }
  const PathLimits& limits_;
  std::size_t knot_;
};

// At its begin a segment's speed does what it does afterwards, at its end what it did before.
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

Found find_number_defect(const KnotPath& path, std::size_t knot, double period_s) {
  const PathKnot& here = path.knots[knot];
  for (const auto& [name, number] :
       {std::pair{"time_s = ", here.time_s}, std::pair{"position_rad = ", here.position_rad},
        std::pair{"velocity_rad_s = ", here.velocity_rad_s}})
    if (!std::isfinite(number))
      return PathDefect{PathDefect::Kind::kNotFinite, knot, here.time_s, number, 0.0, name};
  const double earliest_s = knot == 0 ? 0.0 : path.knots[knot - 1].time_s + period_s;
  const bool first_is_late = knot == 0 && here.time_s > 0.0;
  // A path is made in decimals: a knot that is a period later may be so but for its last bits.
  if (first_is_late || here.time_s * kRounding < earliest_s)
    return PathDefect{PathDefect::Kind::kTime, knot, here.time_s, here.time_s, earliest_s};
  if (here.time_s > kLongestPath_s)
    return PathDefect{PathDefect::Kind::kDuration, knot, here.time_s, here.time_s, kLongestPath_s};
  const bool end = knot == 0 || knot + 1 == path.count;
  if (end && std::abs(here.velocity_rad_s) > kAtBound)
    return PathDefect{PathDefect::Kind::kNotAtRest, knot, here.time_s, here.velocity_rad_s, 0.0};
  return std::nullopt;
}

// Of the number that is wrong, and of the key that bounds it from above, by kind of defect.
struct Words {
  const char* name;
  const char* key;
};
constexpr std::array kWords{Words{"knot_count = ", ""},
                            Words{"", ""},
                            Words{"time_s = ", ""},
                            Words{"time_s = ", ""},
                            Words{"velocity_rad_s = ", ""},
                            Words{"position_rad = ", "position_max_rad"},
                            Words{"speed in rad/s = ", "speed_limit_rad_s"},
                            Words{"acceleration in rad/s^2 = ", "acceleration_rad_s2"},
                            Words{"deceleration in rad/s^2 = ", "deceleration_rad_s2"},
                            Words{"torque of the inertia alone in N.m = ", "torque_limit_Nm"}};
static_assert(kWords.size() == static_cast<std::size_t>(PathDefect::Kind::kTorque) + 1);

// What would be right, and where the limit is set.
std::string what_is_allowed(const PathDefect& defect, const Words& words) {
  const std::string bound = bound_text(defect.bound);
  if (defect.kind == PathDefect::Kind::kNotFinite) return "a finite number is allowed";
  if (defect.kind == PathDefect::Kind::kNotAtRest) return "0 is allowed, a path begins and ends at rest";
  if (defect.kind == PathDefect::Kind::kTime && defect.knot == 0)
    return "0 is allowed, the first knot begins the path";
  if (defect.kind == PathDefect::Kind::kTime)
    return "at least " + bound + " is allowed, a period after the knot before";
  if (defect.kind == PathDefect::Kind::kPosition && !(defect.value > defect.bound))
    return "at least " + bound + " is allowed (joint.limits.position_min_rad)";
  const std::string key = words.key;
  return "at most " + bound + " is allowed" + (key.empty() ? "" : " (joint.limits." + key + ")");
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

PathDefect wrong_count(double count) {
  return {PathDefect::Kind::kCount, 0, 0.0, count, static_cast<double>(KnotPath::kMostKnots)};
}

std::optional<PathDefect> find_defect(const KnotPath& path, const PathLimits& limits) {
  if (path.count < 2 || path.count > KnotPath::kMostKnots)
    return wrong_count(static_cast<double>(path.count));
  for (std::size_t knot = 0; knot < path.count; ++knot)
    if (auto found = find_number_defect(path, knot, limits.period_s)) return found;
  // Positions are checked before speeds: a path in degrees is refused for its positions.
  for (std::size_t knot = 0; knot < path.count; ++knot) {
    const PathKnot& here = path.knots[knot];
    if (auto found = Judge(limits, knot).position(here.position_rad, here.time_s)) return found;
  }
  // Speeds, too: between two that no joint has no acceleration is a number.
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

std::string describe(const PathDefect& defect) {
  std::ostringstream text;
  if (defect.kind == PathDefect::Kind::kCount) {
    text << "knot_count = " << defect.value << ": from 2 to " << defect.bound << " are allowed";
    return text.str();
  }
  text << "knot " << defect.knot;
  if (std::isfinite(defect.time_s)) text << " (at " << defect.time_s << " s)";
  const Words& words = kWords[static_cast<std::size_t>(defect.kind)];
  text << ": " << words.name << defect.number << beyond_text(defect.value, defect.bound) << ": "
       << what_is_allowed(defect, words);
  return text.str();
}

}  // namespace strainwave
