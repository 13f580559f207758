// SPDX-License-Identifier: BSD-3-Clause
// Joints that stop together. Real-time safe but for the constructor.
//
//   a joint faults, on_fault = "group"  -> the others of its group fault in the same cycle (kGroup), and their drives are stopped
//   one of them is on a path            -> it comes to rest along it, with all of the path's joints, and faults then; not after a fault that
//                                          stops all at once (daemon/realtime/joint/fault_reach.h), nor when anything takes it off the path
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/path/path_follower.h"

namespace strainwave {

class JointGroups {
 public:
  /// Both outlive this object.
  JointGroups(std::span<const std::unique_ptr<JointLoop>> joints, PathFollower& paths)
      : joints_(joints), paths_(paths), stops_off_path_(joints.size(), false) {}

  /// After every joint has made its step. Joints that are off stay off. The loop and the other joints go on.
  void stop_with_the_faulted(const CycleTime& time) noexcept;

 private:
  void stop_group_of(const JointInLoop& faulted, const CycleTime& time) noexcept;
  void stop(std::size_t joint, const CycleTime& time) noexcept;

  std::span<const std::unique_ptr<JointLoop>> joints_;
  PathFollower& paths_;
  std::vector<bool> stops_off_path_;  ///< by joint: it comes to rest along its path, and is to fault then
};

/// A fault of the loop itself, for every joint that is not off.
void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept;

}  // namespace strainwave
