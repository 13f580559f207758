#include "daemon/realtime/joint_group.h"

namespace strainwave {

void stop_faulted_groups(std::span<const std::unique_ptr<JointLoop>> joints, const CycleTime& time) noexcept {
  for (const auto& faulted : joints) {
    if (!faulted->stops_group(time) || faulted->group() < 0) continue;
    for (const auto& other : joints) {
      if (other == faulted || other->group() != faulted->group() || other->at_rest()) continue;
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
