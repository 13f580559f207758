// SPDX-License-Identifier: BSD-3-Clause
// The certificate of a table. The receiver proves it anew without a solver: every gain rule and every blend of them are
// stable on every joint of the box, and the cells cover the box. Not real-time. Source: spring_certificate.h, of each cell.
//
// Proved is the feedback in the loop that the daemon closes around the encoder on the box's side: its velocity from the readings, its lead,
// torques under way. It holds for every delay of the box, for any temperature taken for any other, and for viscous friction from 0 to the largest of
// the rules. Stiffness and both inertias may vary within a cell from sample to sample, damping and friction within the box.
// Not proved: what varies across cells, as a wind-up over several slopes does where those have cells of their own; planned motion and friction
// that is fed forward; counts, static friction, a torque at its limit.
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
  /// The smallest margin with its corner, or what is missing: the part of the box without a cell, the corner that fails.
  std::string text;
};

/// A proof that needs more inequalities than these, of all cells together, is refused: who receives a table pays for it.
inline constexpr int kMostBoxInequalities = 120000;

/// Proves the box of `table`, in which find_defect() finds nothing.
BoxReport certify_box(const GainTable& table);

/// Of a controller with an integrator: V = x' P_0 x, by which anti-windup tells the integral's slow part (scheduled_controller.h), falls under
/// rule 0 on the rigid joint of `plant` without delay or friction.
bool proves_slow_part(const FeedbackGains& gains, const PlantIdentity& plant);

/// The joints of `cell`, with the box's motor (the table's inertia where it is rigid), damping and rules.
SpringBox spring_box(const GainTable& table, const BoxCell& cell);

/// The loop of `table` at a delay.
SpringLoop loop_of(const GainTable& table, int delay_periods);

/// P of `cell`, whole, a row for each state of loop_of().
ProofMatrix lyapunov_of(const GainTable& table, const BoxCell& cell);

/// Which quantity of a joint, a rigid one without a link, is outside the table's box, its value and what is allowed, or nothing.
std::optional<std::string> find_outside_box(const GainTable& table, const std::optional<LinkModel>& link,
                                            int delay_periods);

/// The box in words, without its cells.
std::string describe(const CertifiedBox& box);

}  // namespace strainwave
