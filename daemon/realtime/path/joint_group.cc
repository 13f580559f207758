// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/path/joint_group.h"

namespace strainwave {

void JointGroups::stop_with_the_faulted(const CycleTime& time) noexcept {
  for (const auto& joint : joints_)
    if (joint->joint().stops_group(time)) stop_group_of(joint->joint(), time);
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    if (stops_off_path_[joint] && !joints_[joint]->joint().ordered.on_path()) stop(joint, time);
}

void JointGroups::stop_group_of(const JointInLoop& faulted, const CycleTime& time) noexcept {
  const bool at_once = faulted.others_stop() == OthersStop::kAtOnce;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const JointInLoop& other = joints_[joint]->joint();
    if (&other == &faulted || other.config.group != faulted.config.group) continue;
    if (!at_once && other.ordered.on_path() && paths_.end(joint))
      stops_off_path_[joint] = true;
    else
      stop(joint, time);
  }
}

void JointGroups::stop(std::size_t joint, const CycleTime& time) noexcept {
  stops_off_path_[joint] = false;
  if (joints_[joint]->joint().at_rest()) return;
  joints_[joint]->raise_fault(Fault::kGroup, time);
  joints_[joint]->stop_drive();
}

void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept {
  for (const auto& joint : joints)
    if (joint->mode() != Mode::kOff) joint->raise_fault(fault, time);
}

}  // namespace strainwave
