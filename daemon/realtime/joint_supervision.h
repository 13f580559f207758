// SPDX-License-Identifier: BSD-3-Clause
// What the loop makes of a joint's motion each period: limits that it is at, and faults. Real-time safe.
#pragma once

#include "daemon/realtime/joint_in_loop.h"

namespace strainwave {

/// After the control law: notices of the limits that it met.
void note_limits(JointInLoop& joint) noexcept;
/// Faults of a joint under control, and the load that it yields to.
void check_motion(JointInLoop& joint, const CycleTime& time) noexcept;

}  // namespace strainwave
