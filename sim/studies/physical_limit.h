// SPDX-License-Identifier: BSD-3-Clause
// The physical limit of a run: the time-optimal motion of a rigid joint (sim/studies/time_optimal.h), or the best motion of a
// flexible joint's link (sim/studies/link_limit.h). Effects that the limit does not cover are refused, never ignored. Offline.
#pragma once

#include <optional>

#include "sim/studies/link_limit.h"

namespace strainwave {

struct PhysicalLimit {
  double pi2 = 0.0;                   ///< sum |e / r| over the samples of the run
  std::optional<double> counted_pi2;  ///< for a link: only samples with |e| > kCountedError_rad
};

/// The programme for a run of a joint with a spring: one step from rest at one temperature under one load. Throws InputError naming key,
/// value and what is allowed if one of these changes, or for an effect that the programme does not cover. These are gravity, contact,
/// stiction of the link, kinematic error, lost motion, presliding, friction by direction or torque, current loop, ripple and jitter.
LinkLimitConfig link_limit_of_run(const ClosedLoopConfig& config);

/// Throws InputError as above. For a rigid joint it throws for effects that are not covered, and as run_time_optimal() does.
PhysicalLimit physical_limit(const ClosedLoopConfig& config);

/// Throws InputError for an effect that the time-optimal motion of a rigid joint does not cover.
void require_time_optimal_covers(const JointPlantConfig& plant);

}  // namespace strainwave
