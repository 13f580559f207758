// SPDX-License-Identifier: BSD-3-Clause
// Homing of a joint in the loop, around daemon/realtime/homing.h. Real-time safe.
#pragma once

#include "daemon/realtime/joint_in_loop.h"

namespace strainwave {

Reason begin_homing(JointInLoop& joint, const CycleTime& time) noexcept;
/// One period, before the control law's.
void advance_homing(JointInLoop& joint, const CycleTime& time) noexcept;
/// After the control law's: once the home is found or a hold ordered, the joint holds as soon as it rests.
void end_homing(JointInLoop& joint, const CycleTime& time) noexcept;

}  // namespace strainwave
