// Joints that stop together. Real-time safe.
#pragma once

#include <memory>
#include <span>

#include "daemon/realtime/joint_loop.h"

namespace strainwave {

/// After every joint has made its step: where a fault is to stop its group, the others of that group fault
/// too (kGroup) and their drives are stopped, in the same cycle. Joints that are off stay off. The loop and
/// the other joints go on.
void stop_faulted_groups(std::span<const std::unique_ptr<JointLoop>> joints, const CycleTime& time) noexcept;

/// A fault of the loop itself, for every joint that is not off.
void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept;

}  // namespace strainwave
