// SPDX-License-Identifier: BSD-3-Clause
// Effects of unknown torque and of torque saturation on the loop of a certified table. They are calculated in floating
// point at the corners of every cell, and are no part of the certificate (box_certificate.h). Offline. Joint side, SI.
//
// Stand-off: the l1 norm of the impulse response from a torque to the error at the encoder. From rest, no torque of at
// most 1 N m that is constant over each period causes a larger error. Each value is for one joint and one gain rule.
//
// Region: the law demands v = K x, the torque is u = sat(v) within +-t, and q = u - v. The loop is x+ = H x + B q. In
// {x' P x <= c}, where |G x| <= t, the sector condition q (q + (K - G) x) <= 0 holds. V = x' P x falls there if for some s > 0
//
//   g R^-1 g' <= 2 s - B' P B,    g = B' P H - s (K - G),    R = P - H' P H > 0
//
// The level is c = t^2 / (G P^-1 G') with the G that makes it largest. All gains of a corner share one s, and
// each corner has its own. Any blend of gains and any joint of the cell may then act in every period, as in
// the certificate. The analysis leaves out anti-windup. Source: Tarbouriech, Garcia, Gomes da Silva,
// Queinnec, "Stability and Stabilization of Linear Systems with Saturating Actuators" (2011), section 3.
#pragma once

#include <span>
#include <string>

#include "control/table/gain_table.h"
#include "control/table/spring_certificate.h"

namespace strainwave {

/// The worst values over corners and gains.
struct TableReach {
  double motor_rad_per_Nm = 0.0;  ///< error at the encoder for each N m at the motor, as friction
  double link_rad_per_Nm = 0.0;   ///< the same for each N m at the link, as a load
  /// For each N m of torque that remains after plan, friction and load. Both grow in proportion to it.
  double position_rad_per_Nm = 0.0;    ///< largest error at rest from which the loop returns
  double velocity_rad_s_per_Nm = 0.0;  ///< largest velocity, without error, from which the loop returns
};

/// Reach of one cell with its P. The region is zero if P does not prove a corner.
TableReach reach_of(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                    const ProofMatrix& P);

/// The worst reach over the cells of `table`. certify_box() must have proved its box.
TableReach reach_of(const GainTable& table);

/// The reach in two lines of text. `torque_Nm` > 0: the largest torque that may remain.
std::string describe(const TableReach& reach, double torque_Nm);

}  // namespace strainwave
