// SPDX-License-Identifier: BSD-3-Clause
// The joint whose gear is a spring, sampled and held, and the loop that the daemon closes around it: what certificate is asked of a
// table for such a joint. Not real-time. Joint side, SI.
//
//   Jm wm' = u - b wm + K s + D v          wm = thm',   s = thl - thm,   v = s'
//   Jl wl' = -K s - D v
//
// Static and Coulomb friction are taken away by what is fed forward, as on the rigid joint (design/gains/ts_plant.h); around any equilibrium a
// spring of several slopes is a K between its least and its largest. A rigid joint is the motor alone, without s and v. State of the plant
// and of the loop, delay d:
//
//   p  = [ thm - r, wm, s, v ]
//   y  = thm - r, or thl - r = thm - r + s where the encoder is the link's
//   x  = [ integral, p, z, u one period ago, ..., u d periods ago, l one period ago ]
//   p+ = A p + B u(d periods ago)          [A B; 0 1] = exp(h [Ac Bc; 0 0])
//   l  = F_0 integral + F_1 y + F_2 a (y - z) / h
//   u  = l + n (l - l one period ago)      n: the lead; without one l one period ago is no state, nor is the integral without an integrator
//   z+ = z + a (y - z),   integral+ = integral + h y
//
// a = 1 at the motor: z is the last reading, and its velocity that of two readings; at the link a = velocity_share() (link_velocity.h), and
// a (y - z) / h what it makes of them. So JointReading has it, and ScheduledController the law, to the last term. The exponential is summed
// as a Taylor series; what is left out of it is bounded with the weighted norm max_i sum_j |M_ij| d_j / d_i.
#pragma once

#include <array>

#include "control/table/bounded_matrix.h"
#include "control/table/gain_table.h"

namespace strainwave {

/// One linear joint.
struct SpringPlant {
  double motor_inertia_kgm2 = 0.0;  ///< > 0
  double link_inertia_kgm2 = 0.0;   ///< > 0; 0: a rigid joint, whose stiffness and damping do not count
  double stiffness_Nm_rad = 0.0;    ///< K >= 0
  double damping_Nms_rad = 0.0;     ///< D >= 0
  double viscous_Nms_rad = 0.0;     ///< b >= 0
};

/// h [Ac Bc; 0 0], 5 x 5, of a rigid joint 3 x 3, each entry rounded a few times.
BoundedMatrix spring_generator(const SpringPlant& plant, double period_s);

/// [A B; 0 1]: the exponential of `generator`. Its errors are infinite where the series does not converge fast enough to be
/// bounded: a period of more than about three radians of the free swing.
BoundedMatrix spring_exponential(const BoundedMatrix& generator);

/// How far exp(h M) can be from its interpolation between both ends of M + t N, 0 <= t <= 1, entry by entry: max |d2/dt2| / 8. `size`
/// bounds |M + t N|, `change` |N|, both entry by entry.
ProofMatrix interpolation_error(const ProofMatrix& size, const ProofMatrix& change);

/// The loop that is closed around a joint.
struct SpringLoop {
  double period_s = 0.0;  ///< > 0
  int delay_periods = 0;  ///< 0..kMaxBoxDelay
  EncoderSide encoder_side = EncoderSide::kMotor;
  double lead_periods = 0.0;  ///< n >= 0
  int plant_states = kSpringPlantStates;
  bool has_integrator = true;

  int states() const noexcept {
    return loop_states(plant_states, delay_periods, lead_periods) - (has_integrator ? 0 : 1);
  }
};

/// x+ = H x with `sampled` = [A B; 0 1] of loop.plant_states and one.
BoundedMatrix spring_loop(const BoundedMatrix& sampled, const GainRow& gain, const SpringLoop& loop);

}  // namespace strainwave
