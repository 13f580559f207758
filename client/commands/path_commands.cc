// SPDX-License-Identifier: BSD-3-Clause
// path, pause, resume, and move of several joints: motions in which joints leave and arrive together.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/input_error.h"
#include "client/commands/commands.h"
#include "client/protocol/motion.h"
#include "client/protocol/orders.h"
#include "client/protocol/published_limits.h"
#include "control/trajectory/knot_path.h"
#include "lcmtypes/calm_speed.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

// Share of the joint's possible acceleration. The rest of the torque is for friction and load.
constexpr double kShareOfAcceleration = 0.8;

// A move of one joint and a move of several joints have the same longest duration.
static_assert(kLongestMove_s == kLongestPath_s);

/// Returns once all joints are at the end of the path: the duration of the last one, and the largest error.
Arrival wait_for_all(Client& client, const std::vector<JointPath>& path, const PathWait& wait) {
  try {
    Arrival all;
    for (const Arrival& one : wait_for_path(client, path, wait)) {
      all.duration_s = std::max(all.duration_s, one.duration_s);
      if (std::abs(one.error_rad) > std::abs(all.error_rad)) all.error_rad = one.error_rad;
    }
    return all;
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(
        error.status(),
        fmt::format("stopped waiting; the path goes on. To stop all of its joints: strainwavectl hold {}",
                    path.front().joint));
  }
}

void travel(Client& client, const Output& output, const std::vector<JointPath>& path, bool wait,
            double tolerance_rad) {
  load_path(client, path);
  start_path(client, path);
  std::vector<std::string> joints;
  joints.reserve(path.size());
  for (const JointPath& part : path) joints.push_back(part.joint);
  const double path_s = path_duration_s(path);
  const std::string names = fmt::format("{}", fmt::join(joints, ", "));
  if (!wait)
    return say(output, fmt::format("{}: on a path of {:.3f} s", names, path_s),
               {{"joints", joints}, {"path_s", path_s}, {"arrived", false}});
  const auto tell = [&](const PathPause& pause) {
    say(output,
        pause.paused ? fmt::format("{}: paused at {:.3f} s of {:.3f} s; to continue: strainwavectl resume {}",
                                   names, pause.at_s, pause.of_s, joints.front())
                     : fmt::format("{}: the path continues", names),
        {{"joints", joints},
         {"path_s", path_s},
         {"arrived", false},
         {"paused", pause.paused},
         {"path_time_s", pause.at_s}});
  };
  const Arrival arrival = wait_for_all(client, path, {.tolerance_rad = tolerance_rad, .tell = tell});
  say(output,
      fmt::format("{}: arrived in {}, largest error {} rad", names, duration_text(arrival.duration_s),
                  error_text(arrival.error_rad, tolerance_rad)),
      {{"joints", joints},
       {"path_s", path_s},
       {"arrived", true},
       {"duration_s", arrival.duration_s},
       {"error_rad", arrival.error_rad}});
}

void require_allowed_speed(const std::string& joint, double speed_limit_rad_s, const limits_v1& limits) {
  if (speed_limit_rad_s <= limits.speed_limit_rad_s) return;
  throw InvalidInput(
      fmt::format(
          "{0}: speed_limit_rad_s = {1}: at most {2} is allowed (joint.limits.speed_limit_rad_s of {0})",
          joint, speed_limit_rad_s, limits.speed_limit_rad_s),
      joint);
}

/// Refuses here a path that takes too long. The daemon would name a knot, which the user has not written.
void require_quick_enough(const std::vector<StraightMove>& moves, const std::vector<JointPath>& path) {
  const double duration_s = path_duration_s(path);
  if (duration_s <= kLongestPath_s) return;
  const StraightMove& slowest =
      *std::max_element(moves.begin(), moves.end(), [](const StraightMove& one, const StraightMove& other) {
        return std::abs(one.to_rad - one.from_rad) / one.speed_rad_s <
               std::abs(other.to_rad - other.from_rad) / other.speed_rad_s;
      });
  // One percent more, for the ramps and for rounding in the message.
  constexpr double kMargin = 1.01;
  const double least_rad_s = kMargin * std::abs(slowest.to_rad - slowest.from_rad) / kLongestPath_s;
  throw InvalidInput(
      fmt::format("{}: speed_limit_rad_s = {}: at least {:.3g} is allowed: the way of {:.3g} rad takes "
                  "{:.3g} s at that speed, and joints move together for at most {} s",
                  slowest.joint, slowest.speed_rad_s, least_rad_s,
                  std::abs(slowest.to_rad - slowest.from_rad), duration_s, kLongestPath_s),
      slowest.joint);
}

StraightMove straight_move(const JointTarget& target, const state_v1& state, const limits_v1& limits,
                           double speed_limit_rad_s) {
  const double by_torque_rad_s2 = limits.torque_limit_Nm / limits.inertia_kgm2;
  return {target.joint,
          state.target_position_rad,
          target.position_rad,
          speed_limit_rad_s > 0.0 ? speed_limit_rad_s : kCalmShare * limits.speed_limit_rad_s,
          kShareOfAcceleration * std::min(limits.acceleration_rad_s2, by_torque_rad_s2),
          kShareOfAcceleration * std::min(limits.deceleration_rad_s2, by_torque_rad_s2)};
}

}  // namespace

std::vector<JointPath> read_path(const std::filesystem::path& file) {
  const CsvText csv = read_csv_text(file);
  csv.require_columns({"joint", "time_s", "position_rad", "velocity_rad_s"});
  std::vector<JointPath> path;
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    const std::vector<std::string>& fields = csv.rows[row];
    if (!is_valid_name(fields[0]))
      throw InputError(
          fmt::format("{}: joint = {}: 1 to 24 characters of A-Z a-z 0-9 _ - are allowed, not - first",
                      csv.place(row), fields[0]));
    auto part = std::find_if(path.begin(), path.end(),
                             [&](const JointPath& candidate) { return candidate.joint == fields[0]; });
    if (part == path.end()) part = path.insert(path.end(), JointPath{fields[0], {}});
    const auto number = [&](std::size_t column) {
      return parse_number(fields[column], csv.place(row), csv.columns[column]);
    };
    part->knots.push_back({number(1), number(2), number(3)});
  }
  try {
    check_path(path);
  } catch (const InvalidInput& error) {
    throw InputError(csv.source + ": " + error.what());
  }
  return path;
}

void follow_path(Client& client, const Output& output, const PathArguments& arguments) {
  travel(client, output, read_path(arguments.file), arguments.wait, arguments.tolerance_rad);
}

void move_together(Client& client, const Output& output, const MoveTogetherArguments& arguments) {
  std::vector<std::string> joints;
  for (const JointTarget& target : arguments.targets) joints.push_back(target.joint);
  PublishedLimits published_limits(client, joints);
  std::vector<StraightMove> moves;
  for (const JointTarget& target : arguments.targets) {
    const state_v1& state = client.wait_for_joint(target.joint).state;
    const limits_v1& limits = published_limits.wait_for(target.joint);
    require_in_range(target.joint, target.position_rad, limits);
    require_allowed_speed(target.joint, arguments.speed_limit_rad_s, limits);
    moves.push_back(straight_move(target, state, limits, arguments.speed_limit_rad_s));
  }
  const std::vector<JointPath> path = straight_path(moves);
  require_quick_enough(moves, path);
  travel(client, output, path, arguments.wait, arguments.tolerance_rad);
}

void pause_path(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kPause);
  say(output, joint + ": its path pauses, with all of its joints", {{"joint", joint}, {"accepted", true}});
}

void resume_path(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kResume);
  say(output, joint + ": its path goes on, with all of its joints", {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
