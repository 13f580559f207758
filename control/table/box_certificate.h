// SPDX-License-Identifier: BSD-3-Clause
// The certificate of a gain table. The receiver proves it again, without a solver: every gain rule and every blend of the rules is stable
// on every joint of the box. It also checks that the cells cover the box. Not real-time. Source: spring_certificate.h, for each cell.
//
// The proof covers the feedback in the daemon's loop with an encoder on the box's side: its velocity from the readings, its lead, and torques
// under way. It holds for every delay of the box, for every wrong temperature, and for viscous friction from 0 to the largest of the rules.
// Stiffness and both inertias may vary within a cell from sample to sample, damping and friction within the box.
// Not proved: variation across cells, such as a wind-up over several slopes that have cells of their own; planned motion and friction
// feed-forward; encoder counts, static friction, a saturated torque.
#pragma once

#include <optional>
#include <string>

#include "control/joint/link_model.h"
#include "control/table/gain_table.h"
#include "control/table/spring_certificate.h"

namespace strainwave {

struct BoxReport {
  bool certified = false;
  int inequalities = 0;
  /// The smallest margin with its corner; or the reason for failure: a part of the box without a cell, or the corner that fails.
  std::string text;
};

/// Most inequalities of a proof, for all cells together. The receiver refuses a larger proof, since it must compute it.
inline constexpr int kMostBoxInequalities = 120000;

/// Proves the box of `table`, which must have passed find_defect().
BoxReport certify_box(const GainTable& table);

/// For a controller with an integrator: whether V = x' P_0 x falls under rule 0, on the rigid joint of `plant` without delay or friction.
/// Anti-windup takes the slow part of the integral from this V (scheduled_controller.h).
bool proves_slow_part(const FeedbackGains& gains, const PlantIdentity& plant);

/// The joints of `cell`, with the box's motor inertia (a rigid box: the table's inertia), damping, and the rules' viscous friction.
SpringBox spring_box(const GainTable& table, const BoxCell& cell);

/// The loop of `table` at a delay.
SpringLoop loop_of(const GainTable& table, int delay_periods);

/// P of `cell` as a full matrix, with a row for each state of loop_of().
ProofMatrix lyapunov_of(const GainTable& table, const BoxCell& cell);

/// Names a quantity of the joint outside the table's box, with its value and what is allowed; or nothing. A rigid joint has no `link`.
std::optional<std::string> find_outside_box(const GainTable& table, const std::optional<LinkModel>& link,
                                            int delay_periods);

/// The box in words, without its cells.
std::string describe(const CertifiedBox& box);

}  // namespace strainwave
