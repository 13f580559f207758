// SPDX-License-Identifier: BSD-3-Clause
// Faults that stop more than one joint. Real-time safe.
#pragma once

#include <memory>
#include <span>

#include "daemon/realtime/joint/joint_loop.h"

namespace strainwave {

/// After every joint has made its step. Where a joint has faulted in this cycle, the others of its group fault (kGroup) and their drives are
/// stopped. Joints that are off stay off.
void stop_groups_of_the_faulted(std::span<const std::unique_ptr<JointLoop>> joints,
                                const CycleTime& time) noexcept;

/// A fault of the loop itself, for every joint that is not off.
void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept;

}  // namespace strainwave
