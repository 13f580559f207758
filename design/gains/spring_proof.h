// SPDX-License-Identifier: BSD-3-Clause
// Finds, for given gains, a matrix P for each cell of a box of joints. control/table/spring_certificate.h verifies it. Offline.
//
// P has the least trace subject to   P - H' P H >= W   at every corner and for every gain,   W diagonal.
// The states are balanced by the corners' own Lyapunov matrices.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "control/table/spring_certificate.h"
#include "design/gains/sdp_solver.h"

namespace strainwave {

/// The verified P of one box, or nothing if the solver finds none that certify() accepts.
std::optional<ProofMatrix> find_spring_lyapunov(std::span<const GainRow> gains, const SpringBox& box,
                                                const SpringLoop& loop, const SdpOptions& options = {});

enum class SpringOutcome {
  kCertified,  ///< every cell has its P
  kUnstable,   ///< the loop of `unstable` is unstable
  kNotFound,   ///< no P for `cell`; a cut would exceed `most_cells` or make cells too narrow
};

/// A cell and the P that proves it.
struct ProvedCell {
  SpringBox box;
  ProofMatrix P;
};

struct SpringProof {
  SpringOutcome outcome = SpringOutcome::kNotFound;
  std::vector<ProvedCell> cells;
  int inequalities = 0;  ///< of all proved cells
  SpringReport worst;    ///< the smallest margin of these cells
  WorstCorner unstable;
  SpringBox cell;
  int most_cells = 0;
};

/// Cuts `box` by stiffness and link inertia into cells until each has a P. Then every joint of the box is proved stable. Its stiffness and
/// link inertia may vary within a cell, its motor inertia, damping and viscous friction within the box. Takes tenths of a second per cell.
SpringProof prove_spring_box(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                             int most_cells = 300);

/// The box of a joint: stiffness over the gear's slopes, no damping, viscous friction from 0 to the largest
/// of the rules. Throws InputError if the catalogue does not have `gear`.
SpringBox spring_box(const FuzzyFriction& friction, const std::string& gear,
                     const BoxRange& motor_inertia_kgm2, const BoxRange& link_inertia_kgm2);

/// The result in words, in one line.
std::string describe(const SpringProof& proof);

}  // namespace strainwave
