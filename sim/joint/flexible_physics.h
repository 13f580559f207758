// SPDX-License-Identifier: BSD-3-Clause
// The joint as motor and link with the gear's spring between them, and every effect of sim/joint/joint_effects.h. Joint side, SI.
// Real-time safe: advance() allocates nothing and throws nothing. Source: docs/flexible-joint.md.
//
//   Jm wm' = Tm - F(wm, T, ts) - (1 + e'(thm)) ts          Tm: command after current loop, ripple and envelope
//   Jl wl' = ts - load - gravity(thl) - contact(thl, wl) - Fl(wl)
//   ts     = spring(x) + K1 z + D dx/dt                    x = thm + e(thm) - thl, z: lost motion
//
// Between events: the classical Runge-Kutta method of order 4. Motor and link stick and break away as events,
// as in sim/joint/joint_physics.h. The motor sticks at wm = 0 while |Tm - (1 + e') ts| <= Fs. The link sticks
// at wl = 0 while the torque on it is within its own static friction. The simulation shortens the step until
// it ends at the event. With presliding the motor's friction is a state, and the motor has no such events.
#pragma once

#include "sim/joint/joint_effects.h"
#include "sim/joint/joint_physics.h"

namespace strainwave {

struct FlexibleState {
  JointState motor;
  JointState link;               ///< follows the motor if there is no transmission
  double lost_motion_rad = 0.0;  ///< z
  double bristle_rad = 0.0;      ///< mean deflection of the bristles, with presliding
  double current_Nm = 0.0;       ///< torque behind the current loop, before ripple and envelope
};

/// Everything that does not change during a run.
struct FlexibleJoint {
  JointParameters motor;  ///< inertia at the motor's side
  JointEffects effects;
};

/// Advances `state` by `duration_s` in `substeps` >= 1 equal steps; `input` is constant over it.
void advance(FlexibleState& state, const FlexibleJoint& joint, const JointInput& input, double duration_s,
             int substeps) noexcept;

/// Torque in N.m that the gear transmits to the link; 0 without transmission.
double transmitted_torque_Nm(const FlexibleJoint& joint, const FlexibleState& state) noexcept;

/// Motor torque in N.m after ripple and envelope.
double motor_torque_Nm(const FlexibleJoint& joint, const FlexibleState& state,
                       const JointInput& input) noexcept;

/// Kinetic energy and the energy that springs, gravity and contact store, in J.
double mechanical_energy_J(const FlexibleJoint& joint, const FlexibleState& state) noexcept;

}  // namespace strainwave
