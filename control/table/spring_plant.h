// SPDX-License-Identifier: BSD-3-Clause
// The joint with the gear as a spring, sampled with held torque, and the daemon's loop around it. The certificate of a table for such a
// joint is about this loop. Not real-time. Joint side, SI.
//
//   Jm wm' = u - b wm + K s + D v          wm = thm',   s = thl - thm,   v = s'
//   Jl wl' = -K s - D v
//
// Feed-forward removes static and Coulomb friction, as on the rigid joint (design/gains/ts_plant.h). Around any equilibrium a spring with
// several slopes is a K between its least and its largest. A rigid joint is the motor alone, without s and v. States of the plant and of
// the loop, with a delay of d periods:
//
//   p  = [ thm - r, wm, s, v ]
//   y  = thm - r, or thl - r = thm - r + s where the encoder is the link's
//   x  = [ integral, p, z, u one period ago, ..., u d periods ago, l one period ago ]
//   p+ = A p + B u(d periods ago)          [A B; 0 1] = exp(h [Ac Bc; 0 0])
//   l  = F_0 integral + F_1 y + F_2 a (y - z) / h
//   u  = l + n (l - l one period ago)      n: the lead; l one period ago is a state only with a lead, the integral only with an integrator
//   z+ = z + a (y - z),   integral+ = integral + h y
//
// With the encoder on the motor a = 1: z is the last reading, and the velocity is the difference of two readings. On the link a = velocity_share()
// (link_velocity.h), and a (y - z) / h is the filtered velocity. JointReading and ScheduledController compute exactly this. The exponential
// is a Taylor series; the weighted norm max_i sum_j |M_ij| d_j / d_i bounds its remainder.
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

/// h [Ac Bc; 0 0], 5 x 5, or 3 x 3 for a rigid joint. Each entry is rounded a few times.
BoundedMatrix spring_generator(const SpringPlant& plant, double period_s);

/// [A B; 0 1]: the exponential of `generator`. Its errors are infinite where the series converges too slowly for a bound: if a period lasts
/// more than about three radians of the free swing.
BoundedMatrix spring_exponential(const BoundedMatrix& generator);

/// Bound on the error of linear interpolation between exp(h M) and exp(h (M + N)): max |d2/dt2| / 8 for M + t N, 0 <= t <= 1, entry by entry.
/// `size` bounds h |M + t N|, `change` h |N|, both entry by entry.
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

/// H of x+ = H x. `sampled` is [A B; 0 1], with one row more than loop.plant_states.
BoundedMatrix spring_loop(const BoundedMatrix& sampled, const GainRow& gain, const SpringLoop& loop);

}  // namespace strainwave
