// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/joint_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <strainwave/path_v1.hpp>
#include <utility>

#include "base/printable.h"
#include "client/protocol/motion.h"
#include "client/protocol/orders.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

static_assert(std::size(path_v1{}.time_s) == JointPath::kMostKnots);

// Shortest duration of a ramp. It keeps the knots several periods of any daemon apart.
constexpr double kShortestRamp_s = 0.05;

path_v1 part_of(const JointPath& part, std::int64_t path_id, std::size_t joint_count) {
  path_v1 message{};
  message.path_id = path_id;
  message.joint_count = static_cast<std::int32_t>(joint_count);
  message.knot_count = static_cast<std::int32_t>(part.knots.size());
  for (std::size_t i = 0; i < part.knots.size(); ++i) {
    message.time_s[i] = part.knots[i].time_s;
    message.position_rad[i] = part.knots[i].position_rad;
    message.velocity_rad_s[i] = part.knots[i].velocity_rad_s;
  }
  return message;
}

double farthest_rad(const JointPath& part) {
  double farthest = 0.0;
  for (const JointKnot& knot : part.knots)
    if (std::abs(knot.position_rad) > std::abs(farthest)) farthest = knot.position_rad;
  return farthest;
}

/// The speed of the share of the distance over time: it rises to `rate_1_s` in `up_s`, stays for `even_s` and falls in `down_s`.
struct Trapezoid {
  double rate_1_s = 0.0;
  double up_s = 0.0;
  double even_s = 0.0;
  double down_s = 0.0;
};

Trapezoid trapezoid_of(double rate_1_s, double acceleration_1_s2, double deceleration_1_s2) {
  const double together = acceleration_1_s2 * deceleration_1_s2 / (acceleration_1_s2 + deceleration_1_s2);
  Trapezoid shape;
  shape.rate_1_s = std::min(rate_1_s, std::sqrt(2.0 * together));
  shape.up_s = std::max(kShortestRamp_s, shape.rate_1_s / acceleration_1_s2);
  shape.down_s = std::max(kShortestRamp_s, shape.rate_1_s / deceleration_1_s2);
  const double ramps = 0.5 * shape.rate_1_s * (shape.up_s + shape.down_s);
  shape.even_s = (1.0 - ramps) / shape.rate_1_s;
  if (shape.even_s >= kShortestRamp_s) return shape;
  // The even part is absent, or too short for its own knots. The ramps take the whole distance.
  shape.even_s = 0.0;
  shape.rate_1_s = std::min(shape.rate_1_s, 2.0 / (shape.up_s + shape.down_s));
  const double longer = 2.0 / (shape.rate_1_s * (shape.up_s + shape.down_s));
  shape.up_s *= longer;
  shape.down_s *= longer;
  return shape;
}

JointPath along(const StraightMove& move, const Trapezoid& shape) {
  const double way_rad = move.to_rad - move.from_rad;
  const double velocity_rad_s = shape.rate_1_s * way_rad;
  const double up_share = 0.5 * shape.rate_1_s * shape.up_s;
  JointPath path{move.joint, {{0.0, move.from_rad, 0.0}}};
  path.knots.push_back({shape.up_s, move.from_rad + up_share * way_rad, velocity_rad_s});
  if (shape.even_s > 0.0)
    path.knots.push_back({shape.up_s + shape.even_s,
                          move.from_rad + (up_share + shape.rate_1_s * shape.even_s) * way_rad,
                          velocity_rad_s});
  path.knots.push_back({shape.up_s + shape.even_s + shape.down_s, move.to_rad, 0.0});
  return path;
}

/// Watches a path during a wait. All joints share the time on the path, so that the first joint shows it.
class PathLook {
 public:
  PathLook(Client& client, const std::vector<JointPath>& path, const PathWait& wait)
      : view_(client.wait_for_joint(path.front().joint)),
        joint_(path.front().joint),
        wait_(wait),
        pause_{false, 0.0, path_duration_s(path)} {}

  void operator()() {
    const double at_s = view_.state.path_time_s;
    const bool on_path = !std::isnan(at_s);
    const bool paused =
        on_path && (view_.state.notices & static_cast<std::int32_t>(Notice::kPathPaused)) != 0;
    const bool changed = on_path && paused != pause_.paused;
    if (on_path) pause_ = {paused, at_s, pause_.of_s};
    if (changed && wait_.tell) wait_.tell(pause_);
    if (seconds_between(begin_, now()) > wait_.timeout_s)
      throw NotDone(fmt::format("{}: the path did not arrive in {} s: {}", joint_, wait_.timeout_s,
                                on_path ? where(pause_) : "its joints are on their way to its end"),
                    joint_);
  }

 private:
  static std::string where(const PathPause& pause) {
    return fmt::format("it is {}at {:.3f} s of {:.3f} s", pause.paused ? "paused " : "", pause.at_s,
                       pause.of_s);
  }

  const JointView& view_;
  std::string joint_;
  const PathWait& wait_;
  PathPause pause_;
  Instant begin_ = now();
};

}  // namespace

void check_path(const std::vector<JointPath>& path) {
  if (path.empty()) throw InvalidInput("a path needs at least one joint");
  std::set<std::string> named;
  for (const auto& [joint, knots] : path) {
    if (!named.insert(joint).second)
      throw InvalidInput(fmt::format("{} is named twice: each joint once is allowed", joint), joint);
    if (knots.size() < 2 || knots.size() > JointPath::kMostKnots)
      throw InvalidInput(fmt::format("{}: {}: 2 to {} are allowed", joint, counted(knots.size(), "knot"),
                                     JointPath::kMostKnots),
                         joint);
    for (std::size_t i = 0; i < knots.size(); ++i)
      for (const auto& [name, number] :
           {std::pair{"time_s", knots[i].time_s}, std::pair{"position_rad", knots[i].position_rad},
            std::pair{"velocity_rad_s", knots[i].velocity_rad_s}})
        if (!std::isfinite(number))
          throw InvalidInput(
              fmt::format("{}: knot {}: {} = {}: a finite number is allowed", joint, i, name, number), joint);
  }
}

void load_path(Client& client, const std::vector<JointPath>& path) {
  check_path(path);
  const std::int64_t path_id = client.new_stream();
  for (const JointPath& part : path) {
    const Answer answer =
        client.request(part.joint, channel_kind::kPath, part_of(part, path_id, path.size()));
    require_accepted(answer, part.joint, "its part of the path",
                     answer.reason == Reason::kOutOfRange ? degrees_hint(farthest_rad(part)) : "");
  }
}

void start_path(Client& client, const std::vector<JointPath>& path) {
  order_accepted(client, path.front().joint, Action::kResume);
}

double path_duration_s(const std::vector<JointPath>& path) {
  double duration_s = 0.0;
  for (const JointPath& part : path) duration_s = std::max(duration_s, part.knots.back().time_s);
  return duration_s;
}

std::vector<Arrival> wait_for_path(Client& client, const std::vector<JointPath>& path, const PathWait& wait) {
  std::vector<JointTarget> targets;
  targets.reserve(path.size());
  for (const JointPath& part : path) targets.push_back({part.joint, part.knots.back().position_rad});
  PathLook look(client, path, wait);
  return wait_until_arrived(client, targets, wait.tolerance_rad, [&] { look(); });
}

std::vector<JointPath> straight_path(const std::vector<StraightMove>& moves) {
  double rate_1_s = std::numeric_limits<double>::infinity();
  double acceleration_1_s2 = rate_1_s;
  double deceleration_1_s2 = rate_1_s;
  for (const StraightMove& move : moves) {
    const double way_rad = std::abs(move.to_rad - move.from_rad);
    if (way_rad == 0.0) continue;
    rate_1_s = std::min(rate_1_s, move.speed_rad_s / way_rad);
    acceleration_1_s2 = std::min(acceleration_1_s2, move.acceleration_rad_s2 / way_rad);
    deceleration_1_s2 = std::min(deceleration_1_s2, move.deceleration_rad_s2 / way_rad);
  }
  // No joint has to move.
  if (!std::isfinite(rate_1_s)) rate_1_s = acceleration_1_s2 = deceleration_1_s2 = 1.0 / kShortestRamp_s;
  const Trapezoid shape = trapezoid_of(rate_1_s, acceleration_1_s2, deceleration_1_s2);
  std::vector<JointPath> path;
  path.reserve(moves.size());
  for (const StraightMove& move : moves) path.push_back(along(move, shape));
  return path;
}

}  // namespace strainwave
