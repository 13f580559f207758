// SPDX-License-Identifier: BSD-3-Clause
// Finds what control/table/spring_certificate.h verifies: for given gains a matrix P per cell of a box of joints. Offline.
//
// P is the least in trace of   P - H' P H / r^2 >= W,   every corner and every gain,   W diagonal,
// in states that are balanced by the corners' own Lyapunov matrices.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "control/table/spring_certificate.h"
#include "design/gains/sdp_solver.h"

namespace strainwave {

/// P of one box, verified; nothing when the solver finds none that is.
std::optional<ProofMatrix> find_spring_lyapunov(std::span<const GainRow> gains, const SpringBox& box,
                                                const SpringLoop& loop, const SdpOptions& options = {});

enum class SpringOutcome {
  kCertified,  ///< every cell has its P
  kUnstable,   ///< `unstable` is
  kNotFound,  ///< no P for `cell`, and it would be cut into more than `most_cells`, or below what a cut is worth
};

/// With the P that proves it.
struct ProvedCell {
  SpringBox box;
  ProofMatrix P;
};

struct SpringProof {
  SpringOutcome outcome = SpringOutcome::kNotFound;
  std::vector<ProvedCell> cells;
  int inequalities = 0;  ///< of those
  SpringReport worst;    ///< the smallest margin of those
  WorstCorner unstable;
  SpringBox cell;
  int most_cells = 0;
};

/// Cuts `box` by stiffness and link inertia into cells until each has a P. Then every joint of the box is proved stable. Its stiffness and
/// link inertia may vary within a cell, its motor inertia, damping and viscous friction within the box. Takes tenths of a second per cell.
SpringProof prove_spring_box(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                             int most_cells = 300);

/// The box of a table's joint: the gear's slopes, no damping, viscous friction from 0 to the largest of the rules. Throws InputError when
/// `gear` is none of the catalogue.
SpringBox spring_box(const FuzzyFriction& friction, const std::string& gear,
                     const BoxRange& motor_inertia_kgm2, const BoxRange& link_inertia_kgm2);

/// In words, one line per delay.
std::string describe(const SpringProof& proof);

}  // namespace strainwave
