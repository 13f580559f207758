// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/path/joint_group.h"

namespace strainwave {

void stop_groups_of_the_faulted(std::span<const std::unique_ptr<JointLoop>> joints,
                                const CycleTime& time) noexcept {
  for (const auto& faulted : joints) {
    if (!faulted->joint().stops_group(time)) continue;
    for (const auto& other : joints) {
      if (other->joint().config.group != faulted->joint().config.group || other->joint().at_rest()) continue;
      other->raise_fault(Fault::kGroup, time);
      other->stop_drive();
    }
  }
}

void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept {
  for (const auto& joint : joints)
    if (joint->mode() != Mode::kOff) joint->raise_fault(fault, time);
}

}  // namespace strainwave
