// SPDX-License-Identifier: BSD-3-Clause
// The joint as a mechanical system: one inertia, friction with true stiction, a motor with limits. It is the
// plant of every closed-loop test of a rigid joint. It is not the controller's model: its friction is the
// Stribeck curve itself. Joint side, SI. Real-time safe: advance() allocates nothing and throws nothing.
//
//   w != 0:  J dw/dt = Tm(w) - load - F(w, T)
//            d(theta)/dt = w
//   w  = 0:  stuck while |Tm(0) - load| <= Fs(T),
//            else the joint breaks away in the direction of Tm(0) - load
//   F: control/friction/friction.h; Zhao (2006), (2-1)..(2-10)
//
// Between events: the classical Runge-Kutta method of order 4, with friction continued smoothly through zero
// velocity. Under constant torque the velocity obeys a scalar autonomous equation, so it is monotone: a step holds at
// most one change of sign. The change is the root of the step's cubic dense output, found to rounding. There the
// joint is at rest, and sticks or breaks away for the remaining time. The sign is never smoothed.
#pragma once

#include "control/friction/friction.h"
#include "control/joint/motor_limits.h"

namespace strainwave {

/// Everything that does not change during a run.
struct JointParameters {
  double inertia_kgm2 = 0.0;           ///< J > 0, motor and load seen at the joint
  StribeckShape stribeck;              ///< shape of friction over velocity
  ExponentialTemperatureLaw friction;  ///< size of friction over temperature
};

/// State of the joint. `stuck` implies velocity_rad_s == 0.
struct JointState {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  bool stuck = true;
};

/// Inputs of the joint during one period, all constant.
struct JointInput {
  double torque_Nm = 0.0;       ///< commanded motor torque
  double load_torque_Nm = 0.0;  ///< external torque; positive opposes positive motor torque
  FrictionParameters friction;  ///< at this period's temperature
  MotorLimits motor;            ///< what the motor can deliver
};

/// Advances `state` by `duration_s` in `substeps` >= 1 equal steps.
void advance(JointState& state, const JointParameters& joint, const JointInput& input, double duration_s,
             int substeps) noexcept;

/// Acceleration in rad/s^2 of a joint that moves in `direction` (+1 or -1) at `velocity_rad_s`. Friction is
/// continued smoothly to velocities of the other sign, and is Fs at rest.
double moving_acceleration_rad_s2(const JointParameters& joint, const JointInput& input, double direction,
                                  double velocity_rad_s) noexcept;

/// Kinetic energy in J.
constexpr double kinetic_energy(const JointParameters& joint, const JointState& state) noexcept {
  return 0.5 * joint.inertia_kgm2 * state.velocity_rad_s * state.velocity_rad_s;
}

}  // namespace strainwave
