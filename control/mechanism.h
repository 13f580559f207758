// SPDX-License-Identifier: BSD-3-Clause
// The parts of the controller that a study can switch off, one at a time, to show what each is worth (`strainwave-sim ablation`).
// The daemon runs all of them.
#pragma once

namespace strainwave {

enum class Mechanism {
  kNone,              ///< nothing is switched off
  kWindUp,            ///< the plan has the gear's spring
  kFriction,          ///< the plan feeds friction forward
  kFrictionLearning,  ///< by the feedback of motions
  kLoadLearning,      ///< by the feedback at rest
  kRestTorque,        ///< within a count of its place the joint is held by a constant torque
  kCorrections,       ///< small motions bring the last counts
  kPace,              ///< a torque that is spent slows the motion down
  kGivingWay,         ///< the plan gives way when it needs more torque than the motion
};

}  // namespace strainwave
