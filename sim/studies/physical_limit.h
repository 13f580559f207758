// SPDX-License-Identifier: BSD-3-Clause
// The physical limit of a run, whatever its joint: of a rigid one the time-optimal motion (sim/studies/time_optimal.h), of one with a
// spring the best motion of its link (sim/studies/link_limit.h). What the limit cannot take is refused, never left out. Offline.
#pragma once

#include <optional>

#include "sim/studies/link_limit.h"

namespace strainwave {

struct PhysicalLimit {
  double pi2 = 0.0;                   ///< sum |e / r| over the samples of the run
  std::optional<double> counted_pi2;  ///< of a link: only samples with |e| > kCountedError_rad
};

/// The programme of a run of a joint with a spring: one step from rest at one temperature under one load. Throws InputError that names
/// the key, its value and what is allowed for every effect that is not linear, and for what changes during the run. Not linear are gravity,
/// contact, stiction of the link, kinematic error, lost motion, presliding, friction by torque, current loop, ripple and jitter.
LinkLimitConfig link_limit_of_run(const ClosedLoopConfig& config);

/// Throws InputError as above; of a rigid joint for the effects, too, and as run_time_optimal() does.
PhysicalLimit physical_limit(const ClosedLoopConfig& config);

/// Throws InputError for an effect of a rigid joint that its time-optimal motion does not know.
void require_time_optimal_covers(const JointPlantConfig& plant);

}  // namespace strainwave
