// SPDX-License-Identifier: BSD-3-Clause
// The physical limit: the fastest motion that the joint's physics allow, with friction known and no
// controller. Offline.
//
// For each change of the setpoint: full torque towards it, then full torque against it from the one instant
// at which the joint comes to rest exactly on the setpoint (bang-bang, time-optimal for this second-order
// joint), then nothing. The switching instant is a root of the real physics, not of a formula. The motion
// starts at the sample at which the setpoint changes: neither a computer's delay nor a sampled torque slows
// it down.
#pragma once

#include "sim/studies/closed_loop.h"

namespace strainwave {

struct TimeOptimalResult {
  LoopStatistics statistics;  ///< of the samples, as for a controller
  double first_arrival_s =
      -1.0;  ///< duration of the first move, from rest to rest; -1: it is longer than the run
  std::vector<TracePoint> trace;  ///< every sample
};

/// Throws InputError when the plant has no finite peak torque, when that cannot move the joint, and when a
/// setpoint changes before the move to it has ended.
TimeOptimalResult run_time_optimal(const ClosedLoopConfig& config);

}  // namespace strainwave
