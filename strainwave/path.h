// SPDX-License-Identifier: BSD-3-Clause
// A path: a motion of one or several joints that the daemon checks before it begins. docs/streams.md, "Paths". Not real-time.
//
//     strainwave::Path path({{elbow, {{0, 0, 0}, {0.5, 0.2, 0.6}, {1, 0.4, 0}}}, {wrist, {{0, 0, 0}, {1, -0.2, 0}}}});
//     path.start();
//     path.wait();
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "strainwave/joint.h"
#include "strainwave/joint_knot.h"
#include "strainwave/move_order.h"

namespace strainwave {

/// The motion of one joint on a path.
struct PathPart {
  const Joint& joint;
  /// 2 to 320 knots: time_s begins at 0, velocity_rad_s is 0 in the first and the last. Between knots the joint follows cubics.
  std::vector<JointKnot> knots;
};

struct JointPath;

/// All orders use the options of the first joint. The motion goes on when this object or the program ends. Throws ClientError.
class Path {
 public:
  /// Nothing moves before start(). Throws InvalidInput: no joint, one joint twice, joints of two daemons, numbers that are not finite.
  explicit Path(const std::vector<PathPart>& parts);
  ~Path();
  Path(Path&&) noexcept;
  Path& operator=(Path&&) noexcept;
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

  /// Starts all joints in one cycle, or none: each must hold within 1 mrad of its first knot. Throws Refused, which names knot and limit
  /// when the path exceeds a joint's limits.
  void start();
  /// Stops all joints on the path, as quickly as their acceleration limits allow.
  void pause();
  /// Continues the path after a pause.
  void resume();
  /// Ends the path: each joint stops within its own limits, off the path. Returns once they hold. Needs no key.
  void hold();
  /// Waits until every joint is within `tolerance_rad` of its last knot and stays there. Returns one Arrival per part, timed from now. Also
  /// waits while the path is paused: see State::has(Notice::kPathPaused) and State::path_time_s. Throws Faulted, NoAnswer, and NotDone:
  /// after `timeout_s`, with the path's time and whether it is paused, or if something else ended the path. Can also wait for a path that
  /// another program started, while it is under way. If no path is under way, throws NotDone soon, even if the joints stand at its end.
  std::vector<Arrival> wait(double tolerance_rad = 1e-3,
                            double timeout_s = std::numeric_limits<double>::infinity());

 private:
  JointLink& first() { return *links_.front(); }
  /// Returns the first joint that is not on its way to this path's end; null: the path is under way. It is not under way if all joints
  /// stand at its end, since another motion may have brought them there.
  const JointPath* joint_elsewhere();
  void check_under_way();

  std::vector<std::shared_ptr<JointLink>> links_;
  std::vector<JointPath> parts_;
  bool started_ = false;
};

}  // namespace strainwave
