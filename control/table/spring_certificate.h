// SPDX-License-Identifier: BSD-3-Clause
// The certificate of gains on a joint, rigid or with the gear as a spring. From gains and a matrix P the receiver proves, without a solver,
// that the loop of spring_plant.h, sampled with held torque, is stable on every joint of a box. Not real-time.
//
//   P - H' P H > 0,   P > 0        H = H(K, 1/Jl, D, b, 1/Jm, j)
//
// for every stiffness K, link inertia Jl, damping D, viscous friction b and motor inertia Jm of the box and every gain j. Then V = x' P x
// falls with each sample, even if these and the blend of the gains change from one sample to the next. This covers a spring with several
// slopes, changing friction and every wrong temperature. Within a sample they are constant.
//
// Corners suffice: h [Ac Bc; 0 0] is affine in each of K, 1/Jl, D, b and 1/Jm. Its exponential is therefore an interpolation of those at the
// box's 32 corners, within E (interpolation_error(), summed over the five). With |E_v| <= E
//   H = sum_v lambda_v (H_v + E_v),    |H x| <= max_v |(H_v + E_v) x|   in the norm x' P x
// Each inequality is tested for all H that differ from H_v by at most X, entry by entry; X is E plus rounding. With w_i the rows of P H_v,
// e_j unit vectors, D the difference from H_v and any l_ij > 0
//   D' P H_v + H_v' P D <= sum_ij X_ij (l_ij w_i w_i' + e_j e_j' / l_ij) = (P H_v)' diag(a) (P H_v) + diag(b)
//   |D' P D| <= X' |P| X                   entry by entry
// H is affine in the gain, so that the same holds for blends. If E makes a proof fail, the box is halved, with the same P: E falls by a
// factor of four.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "control/table/spring_plant.h"

namespace strainwave {

/// The joints of a proof. A rigid joint has link inertia, stiffness and damping from 0 to 0.
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
/// The corners that differ, and a bound for the joints between them.
struct SpringCorners {
  std::vector<SpringCorner> corners;
  ProofMatrix interpolation;  ///< E, entry by entry
  std::size_t widest =
      0;  ///< the direction with the largest share of E: 0 stiffness, 1 link inertia, 2 damping, 3 viscous friction, 4 motor inertia
};
SpringCorners spring_corners(const SpringBox& box, double period_s);

/// A lower bound, as a symmetric matrix, of P - H' P H for every H within its errors. P is exact.
BoundedMatrix least_fall(const BoundedMatrix& P, const BoundedMatrix& H);

struct SpringReport {
  bool certified = false;
  int inequalities = 0;
  double margin = 0.0;  ///< the smallest, as in PositiveDefiniteResult
  SpringPlant worst;    ///< the corner with this margin, of the box or a part; zeros: the test of P > 0
  int worst_gain = 0;
};

/// P has a row and a column for each of loop.states(). At least one gain. A proof of more than `most_inequalities` fails.
SpringReport certify(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                     const ProofMatrix& P, int most_inequalities = std::numeric_limits<int>::max());

/// Spectral radius of the loop: the largest magnitude of its eigenvalues, which limits every proof. Not rigorous; infinite
/// where an entry is not finite.
double spring_loop_radius(const SpringPlant& plant, const GainRow& gain, const SpringLoop& loop);

/// The corner and gain of `box` with the largest eigenvalue of the loop: above 1 no proof exists. Not rigorous.
struct WorstCorner {
  SpringPlant plant;
  int gain = 0;
  double radius = 0.0;
};
WorstCorner worst_corner(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop);

/// The gains of every rule.
std::vector<GainRow> gains_of(const GainTable& table);

/// A joint in words; and a margin with its corner.
std::string describe(const SpringPlant& plant);
std::string describe(const SpringReport& report);

}  // namespace strainwave
