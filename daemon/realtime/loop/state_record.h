// SPDX-License-Identifier: BSD-3-Clause
// The published record of one joint's cycle. Real-time safe.
#pragma once

#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/joint/joint_in_loop.h"
#include "daemon/realtime/loop/flight_recorder.h"

namespace strainwave {

/// Fills every field except joint_index and those that the gateway adds (utime, session_id, challenge, owner_id, lease_s).
void fill_record(const JointInLoop& joint, const CycleTime& time, StateRecord& record) noexcept;

/// The same cycle for the flight recorder.
FlightSample flight_sample(const StateRecord& record, const CycleTime& time, DriveState drive_state,
                           bool reading_fresh) noexcept;

}  // namespace strainwave
