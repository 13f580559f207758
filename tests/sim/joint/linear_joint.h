// SPDX-License-Identifier: BSD-3-Clause
// A joint with a linear spring and functions that move it, for the tests of the flexible joint.
#pragma once

#include <cmath>

#include "sim/joint/flexible_physics.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {

inline constexpr double kMotor_kgm2 = 0.089;
inline constexpr double kLink_kgm2 = 0.1;
inline constexpr double kStiffness_Nm_rad = 1e4;

inline FlexibleJoint linear_joint() {
  FlexibleJoint joint;
  joint.motor = reference_joint();
  joint.motor.inertia_kgm2 = kMotor_kgm2;
  Transmission gear;
  gear.link_inertia_kgm2 = kLink_kgm2;
  gear.spring = TorsionSpring::linear(kStiffness_Nm_rad);
  joint.effects.transmission = gear;
  return joint;
}

inline JointInput cold(double torque_Nm) {
  JointInput input;
  input.torque_Nm = torque_Nm;
  input.friction = reference_joint().friction.at(-10.0);
  return input;
}

/// Without any friction.
inline JointInput free_of_friction(double torque_Nm) {
  JointInput input;
  input.torque_Nm = torque_Nm;
  return input;
}

inline void run(FlexibleState& state, const FlexibleJoint& joint, const JointInput& input, double duration_s,
                int substeps_per_ms = 10) {
  const int periods = static_cast<int>(std::lround(duration_s * 1e3));
  for (int k = 0; k < periods; ++k) advance(state, joint, input, 1e-3, substeps_per_ms);
}

}  // namespace strainwave
