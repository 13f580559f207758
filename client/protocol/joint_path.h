// SPDX-License-Identifier: BSD-3-Clause
// Paths (docs/streams.md, "Paths"): motions of one or several joints of a daemon. The daemon checks them before they begin, and
// the joints leave, pause and arrive together. Functions throw ClientError: Refused, NoAnswer, InvalidInput. Not real-time.
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

/// The part of one joint in a path.
struct JointPath {
  static constexpr std::size_t kMostKnots = 320;
  std::string joint;
  std::vector<JointKnot> knots;  ///< 2..kMostKnots
};

/// Throws InvalidInput unless `path` has joints, each once and with 2 to kMostKnots knots of finite numbers.
/// The daemon checks the limits of the joints.
void check_path(const std::vector<JointPath>& path);

/// Sends every joint its part. Nothing moves yet. If a joint refuses its part, the joints before it keep theirs without effect.
void load_path(Client& client, const std::vector<JointPath>& path);

/// Starts the loaded path: all joints of `path` in one cycle, or none.
void start_path(Client& client, const std::vector<JointPath>& path);

/// Time of the last knot of all joints. The first knot is at 0.
double path_duration_s(const std::vector<JointPath>& path);

/// Reports that a path was paused, or that it continues.
struct PathPause {
  bool paused = false;
  double at_s = 0.0;  ///< time on the path
  double of_s = 0.0;  ///< duration of the path
};

struct PathWait {
  double tolerance_rad = 1e-3;
  double timeout_s = std::numeric_limits<double>::infinity();  ///< for the whole path, pauses included
  std::function<void(const PathPause&)> tell = nullptr;  ///< called when a pause begins, and when it ends
};

/// Call it after the start. Returns once every joint is within the tolerance of its last knot and stays there; one Arrival
/// per joint, timed from the call. Throws NotDone at the time-out, with the place on the path and whether it is paused.
std::vector<Arrival> wait_for_path(Client& client, const std::vector<JointPath>& path, const PathWait& wait);

/// The motion of one joint on a straight path, with its limits. Speeds and accelerations > 0.
struct StraightMove {
  std::string joint;
  double from_rad = 0.0;
  double to_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double deceleration_rad_s2 = 0.0;
};

/// A path on which all joints start and end at rest, together. At every instant all joints have covered the same share of their distances.
/// The joint that needs the longest time sets the pace. With the largest rates of the share that all joints allow,
///
///   V = min V_i / |d_i|
///   A = min A_i / |d_i|
///   D = min D_i / |d_i|
///
/// the speed of the share, from 0 to 1, is a trapezoid over time.
std::vector<JointPath> straight_path(const std::vector<StraightMove>& moves);

}  // namespace strainwave
