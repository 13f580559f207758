// SPDX-License-Identifier: BSD-3-Clause
// The physical limit: the fastest motion that the joint's physics allow, with known friction and without a
// controller. Offline.
//
// At each change of the setpoint, full torque drives the joint towards it, then full torque brakes, then
// there is no torque. Only one switching instant brings the joint to rest exactly on the setpoint (bang-bang,
// time-optimal for this second-order joint). That instant is a root of the real physics, not of a formula.
// The motion starts at the sample at which the setpoint changes: neither a computer's delay nor a sampled
// torque slows it down.
#pragma once

#include "sim/studies/closed_loop.h"

namespace strainwave {

struct TimeOptimalResult {
  LoopStatistics statistics;      ///< from the samples, as for a controller
  double first_arrival_s = -1.0;  ///< duration of the first move, rest to rest; -1: longer than the run
  std::vector<TracePoint> trace;  ///< every sample
};

/// Throws InputError if the plant has no finite peak torque, if that cannot move the joint, or if a setpoint
/// changes before the move to it has ended.
TimeOptimalResult run_time_optimal(const ClosedLoopConfig& config);

}  // namespace strainwave
