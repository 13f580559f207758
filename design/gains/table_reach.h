// SPDX-License-Identifier: BSD-3-Clause
// What the loop of a certified table does with a torque that it does not know, and from where it returns when its torque is limited.
// Calculated in floating point at the corners of every cell; the certificate itself is box_certificate.h. Offline. Joint side, SI.
//
// Stand-off: the l1 norm of the impulse response from a torque to the error that the encoder sees. A torque that is constant over each
// period and at most 1 N m makes no larger error, from rest, whatever its course. One joint and one gain rule at a time.
//
// Region: with v = K x the torque that the law wants, u = sat(v) within +-t and q = u - v, the loop is x+ = H x + B q. In
// {x' P x <= c}, where |G x| <= t, the sector condition q (q + (K - G) x) <= 0 holds. V = x' P x falls there if for some s > 0
//
//   g R^-1 g' <= 2 s - B' P B,    g = B' P H - s (K - G),    R = P - H' P H > 0
//
// and c = t^2 / (G P^-1 G') for the G that makes this largest. One s serves all gains of a corner, and each corner has its own: then
// any blend of gains and any joint of the cell may act in every period, as in the certificate. The integral is not corrected while
// the torque is limited. Source: Tarbouriech, Garcia, Gomes da Silva, Queinnec, "Stability and Stabilization of Linear Systems with
// Saturating Actuators" (2011), section 3.
#pragma once

#include <span>
#include <string>

#include "control/table/gain_table.h"
#include "control/table/spring_certificate.h"

namespace strainwave {

/// The worst of what is asked for, over corners and gains.
struct TableReach {
  double motor_rad_per_Nm = 0.0;  ///< error at the encoder for each N m at the motor, as friction
  double link_rad_per_Nm = 0.0;   ///< and at the link, as a load
  /// For each N m of torque that the plan, friction and load leave: both grow in proportion to it.
  double position_rad_per_Nm = 0.0;    ///< largest error at rest from which the loop returns
  double velocity_rad_s_per_Nm = 0.0;  ///< largest velocity, without error, from which the loop returns
};

/// Of one cell with its P. Zero where P does not prove a corner.
TableReach reach_of(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                    const ProofMatrix& P);

/// Of `table`, whose box certify_box() proves: the worst of its cells.
TableReach reach_of(const GainTable& table);

/// In two lines. `torque_Nm` > 0: the most that may be left.
std::string describe(const TableReach& reach, double torque_Nm);

}  // namespace strainwave
