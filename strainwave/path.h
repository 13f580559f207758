// SPDX-License-Identifier: BSD-3-Clause
// A path: a motion of one or several joints of a daemon that is checked before it begins. docs/streams.md, "Paths". Not real-time.
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

/// What one joint does on a path.
struct PathPart {
  const Joint& joint;
  /// 2 to 320: time_s from 0 on, position_rad, velocity_rad_s, 0 in the first and the last. Between them it goes along cubics.
  std::vector<JointKnot> knots;
};

struct JointPath;

/// Orders go out with the options of its first joint. Goes on when this object or the program ends. Throws ClientError.
class Path {
 public:
  /// Nothing moves before start(). Throws InvalidInput: no joint, one twice, joints of two daemons, numbers that are none.
  explicit Path(const std::vector<PathPart>& parts);
  ~Path();
  Path(Path&&) noexcept;
  Path& operator=(Path&&) noexcept;
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

  /// All joints begin in one cycle, or none: each must hold within 1 mrad of its first knot. Throws Refused, which names knot and limit
  /// when the path asks for more than a joint can do.
  void start();
  /// Stops on the path, with all joints, as quickly as their accelerations allow.
  void pause();
  /// Goes on after a pause.
  void resume();
  /// Ends the path: each joint stops within its own limits, off the path. Returns once they hold. Needs no key.
  void hold();
  /// Returns once every joint is within `tolerance_rad` of its last knot and stays there: in the order of the parts, timed from now. Waits
  /// while the path is paused, too: see State::has(Notice::kPathPaused) and State::path_time_s. Throws Faulted, NoAnswer, and
  /// NotDone: after `timeout_s`, which says where the path is and whether it is paused, or when something else ended it.
  /// Of a path that another program started, too, while it is under way; of one that is not, NotDone soon, also where the joints stand at
  /// its end.
  std::vector<Arrival> wait(double tolerance_rad = 1e-3,
                            double timeout_s = std::numeric_limits<double>::infinity());

 private:
  JointLink& first() { return *links_.front(); }
  /// Of those that are not on their way to this path's end the first; null: it is under way. Joints that stand at its end may have come
  /// there in any way.
  const JointPath* joint_elsewhere();
  void check_under_way();

  std::vector<std::shared_ptr<JointLink>> links_;
  std::vector<JointPath> parts_;
  bool started_ = false;
};

}  // namespace strainwave
