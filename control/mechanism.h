// SPDX-License-Identifier: BSD-3-Clause
// The parts of the controller that a study can switch off, one at a time, to show the benefit of each (`strainwave-sim ablation`).
// The daemon runs all of them.
#pragma once

namespace strainwave {

enum class Mechanism {
  kNone,              ///< nothing is switched off
  kWindUp,            ///< wind-up of the gear's spring in the plan
  kFriction,          ///< friction feed-forward of the plan
  kFrictionLearning,  ///< from the feedback during motions
  kLoadLearning,      ///< from the feedback at rest
  kRestTorque,        ///< a constant torque holds the joint within a count of its target
  kCorrections,       ///< small motions at rest correct the last counts
  kPace,              ///< a saturated torque lowers the accelerations
  kGivingWay,         ///< the plan yields when its regulator needs more torque than the motion
};

}  // namespace strainwave
