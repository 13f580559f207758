// SPDX-License-Identifier: BSD-3-Clause
// Paths (docs/streams.md, "Paths"): motions of one or several joints of a daemon that are checked before they begin, and leave, pause and
// arrive together. Throw ClientError: Refused, NoAnswer, InvalidInput. Not real-time.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/joint_knot.h"
#include "strainwave/move_order.h"

namespace strainwave {

/// What one joint does on a path.
struct JointPath {
  static constexpr std::size_t kMostKnots = 320;
  std::string joint;
  std::vector<JointKnot> knots;  ///< 2..kMostKnots
};

/// Throws InvalidInput unless `path` has joints, each of them once and with 2 to kMostKnots knots of finite numbers. What the joints can
/// do, the daemon judges.
void check_path(const std::vector<JointPath>& path);

/// Sends every joint its part. Nothing moves; where a part is refused, the joints before it have theirs and do nothing with it.
void load_path(Client& client, const std::vector<JointPath>& path);

/// Starts what was loaded: all joints of `path` in one cycle, or none.
void start_path(Client& client, const std::vector<JointPath>& path);

/// From its first knot to the last of all joints.
double path_duration_s(const std::vector<JointPath>& path);

/// A path was paused, or it goes on.
struct PathPause {
  bool paused = false;
  double at_s = 0.0;  ///< of the path
  double of_s = 0.0;  ///< its duration
};

struct PathWait {
  double tolerance_rad = 1e-3;
  double timeout_s = std::numeric_limits<double>::infinity();  ///< of all of it, pauses included
  std::function<void(const PathPause&)> tell = nullptr;  ///< called when a pause begins, and when it ends
};

/// After a start: returns once every joint is within the tolerance of its last knot and stays there; by joint, timed from the call. Throws
/// NotDone when that takes too long, which says where the path is and whether it is paused.
std::vector<Arrival> wait_for_path(Client& client, const std::vector<JointPath>& path, const PathWait& wait);

/// A joint's share of a straight motion, and what it may need. Speeds and accelerations > 0.
struct StraightMove {
  std::string joint;
  double from_rad = 0.0;
  double to_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double deceleration_rad_s2 = 0.0;
};

/// The path on which all joints leave at rest, keep the same share of their ways behind them at every instant, and arrive at rest
/// together: as fast as the one that takes longest. With the largest share rates that all allow,
///
///   V = min V_i / |d_i|
///   A = min A_i / |d_i|
///   D = min D_i / |d_i|
///
/// the share goes from 0 to 1 in a trapezoid of speed.
std::vector<JointPath> straight_path(const std::vector<StraightMove>& moves);

}  // namespace strainwave
