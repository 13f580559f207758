// SPDX-License-Identifier: BSD-3-Clause
// The certificate of gains on a joint, rigid or with a gear that is a spring. From gains and a matrix P the receiver proves, without a solver, that
// the sampled and held loop of spring_plant.h is stable everywhere in a box of joints. Not real-time.
//
//   P - H' P H > 0,   P > 0        H = H(K, 1/Jl, D, b, 1/Jm, j)
//
// for every stiffness K, link inertia Jl, damping D, viscous friction b and motor inertia Jm of the box and every gain j. Then V = x' P x
// falls with each sample, however these and the blend of the gains change from one sample to the next. That covers a spring of several slopes,
// friction that changes, and a temperature that is taken for any other. Within a sample they stand still.
//
// Corners are enough: h [Ac Bc; 0 0] is affine in each of K, 1/Jl, D, b and 1/Jm, so that its exponential is what interpolates those of the
// box's 32 corners, within E (interpolation_error(), summed over the five). With |E_v| <= E
//   H = sum_v lambda_v (H_v + E_v),    |H x| <= max_v |(H_v + E_v) x|   in the norm x' P x
// and every inequality is tested for all H that are nearer to H_v than X, entry by entry: E and rounding. With w_i the rows of P H_v, e_j
// unit vectors, D the difference and any l_ij > 0
//   D' P H_v + H_v' P D <= sum_ij X_ij (l_ij w_i w_i' + e_j e_j' / l_ij) = (P H_v)' diag(a) (P H_v) + diag(b)
//   |D' P D| <= X' |P| X                   entry by entry
// H is affine in the gain, so that the same holds for blends. Where E is what a proof fails on, the box is cut in two, with the same P: E
// falls by four.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "control/table/spring_plant.h"

namespace strainwave {

/// The joints that are meant. A rigid one: link inertia, stiffness and damping from 0 to 0.
struct SpringBox {
  BoxRange motor_inertia_kgm2;  ///< > 0
  BoxRange link_inertia_kgm2;   ///< > 0
  BoxRange stiffness_Nm_rad;    ///< > 0
  BoxRange damping_Nms_rad;     ///< >= 0, of the wind-up's speed
  BoxRange viscous_Nms_rad;     ///< >= 0, of the motor's side
};

/// A corner of a box with its sampled plant, [A B; 0 1], and the errors of rounding.
struct SpringCorner {
  SpringPlant plant;
  BoundedMatrix sampled;
};
/// The corners that differ, and what lies between them.
struct SpringCorners {
  std::vector<SpringCorner> corners;
  ProofMatrix interpolation;  ///< E, entry by entry
  std::size_t widest =
      0;  ///< the direction with most of it: 0 stiffness, 1 link inertia, 2 damping, 3 viscous friction, 4 motor inertia
};
SpringCorners spring_corners(const SpringBox& box, double period_s);

/// No more, as a symmetric matrix, than P - H' P H for any H within its errors. P exact.
BoundedMatrix least_fall(const BoundedMatrix& P, const BoundedMatrix& H);

struct SpringReport {
  bool certified = false;
  int inequalities = 0;
  double margin = 0.0;  ///< the least, as PositiveDefiniteResult::margin
  SpringPlant worst;    ///< the corner that has it, of the box or of a part; zeros: P > 0 itself
  int worst_gain = 0;
};

/// P: a row and a column for each of loop.states(). At least one gain. Not certified is what needs more than `most_inequalities`.
SpringReport certify(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                     const ProofMatrix& P, int most_inequalities = std::numeric_limits<int>::max());

/// The largest eigenvalue of the loop, in magnitude: what no proof can be better than. Not rigorous; infinite
/// where an entry is not finite.
double spring_loop_radius(const SpringPlant& plant, const GainRow& gain, const SpringLoop& loop);

/// The corner and gain of `box` with the largest eigenvalue of the loop: above 1 no proof exists. Not rigorous.
struct WorstCorner {
  SpringPlant plant;
  int gain = 0;
  double radius = 0.0;
};
WorstCorner worst_corner(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop);

/// Every rule's.
std::vector<GainRow> gains_of(const GainTable& table);

/// The link's side, the spring and friction in words; and a margin with its corner.
std::string describe(const SpringPlant& plant);
std::string describe(const SpringReport& report);

}  // namespace strainwave
