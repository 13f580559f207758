// The joint whose gear is a spring, sampled and held, and the loop that the daemon closes around it: what certificate is asked of a
// table for such a joint. Not real-time. Joint side, SI.
//
//   Jm wm' = u - b wm + K s + D v          wm = thm',   s = thl - thm,   v = s'
//   Jl wl' = -K s - D v
//
// Static and Coulomb friction are taken away by what is fed forward, as on the rigid joint (ts_plant.h); around any equilibrium a
// spring of several slopes is a K between its least and its largest. State of the plant and of the loop, delay d:
//
//   p  = [ thm - r, wm, s, v ]
//   x  = [ integral, p, thm - r one period ago, u one period ago, ..., u d periods ago ]
//   p+ = A p + B u(d periods ago)          [A B; 0 1] = exp(h [Ac Bc; 0 0])
//   u  = F_0 integral + F_1 (thm - r) + F_2 (thm - thm one period ago) / h
//   integral+ = integral + h (thm - r)
//
// which is StateEstimator's velocity from two readings and ScheduledController's law, to the last term. The exponential is summed as
// a Taylor series; what is left out of it is bounded with the weighted norm max_i sum_j |M_ij| d_j / d_i.
#pragma once

#include <array>

#include "control/bounded_matrix.h"
#include "control/certified_box.h"
#include "control/gain_table.h"

namespace strainwave {

/// One linear joint.
struct SpringPlant {
  double motor_inertia_kgm2 = 0.0;  ///< > 0
  double link_inertia_kgm2 = 0.0;   ///< > 0
  double stiffness_Nm_rad = 0.0;    ///< K >= 0
  double damping_Nms_rad = 0.0;     ///< D >= 0
  double viscous_Nms_rad = 0.0;     ///< b >= 0
};

/// States of the plant; of the loop kSpringLoopStates (certified_box.h) + d.
inline constexpr int kSpringPlantStates = 4;
inline constexpr int kMaxSpringDelay = kMaxProofStates - kSpringLoopStates;

/// h [Ac Bc; 0 0], 5 x 5, each entry rounded a few times.
BoundedMatrix spring_generator(const SpringPlant& plant, double period_s);

/// [A B; 0 1], 5 x 5: the exponential of `generator`. Its errors are infinite where the series does not converge fast enough to be
/// bounded: a period of more than about three radians of the free swing.
BoundedMatrix spring_exponential(const BoundedMatrix& generator);

/// How far exp(h M) can be from its interpolation between both ends of M + t N, 0 <= t <= 1, entry by entry: max |d2/dt2| / 8. `size`
/// bounds |M + t N|, `change` |N|, both entry by entry.
ProofMatrix interpolation_error(const ProofMatrix& size, const ProofMatrix& change);

/// x+ = H x with `sampled` = [A B; 0 1]. 0 <= delay_periods <= kMaxSpringDelay.
BoundedMatrix spring_loop(const BoundedMatrix& sampled, const GainRow& gain, double period_s,
                          int delay_periods);

}  // namespace strainwave
