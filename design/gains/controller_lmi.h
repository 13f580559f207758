// SPDX-License-Identifier: BSD-3-Clause
// The LMIs of the scheduled controllers, for plants of any size given as matrices. Offline.
// Source: Zhao (2006), (5-6)..(5-12), (5-46), Theorems 2 and 3, (5-72)..(5-77).
//
// For rules x+ = A_j x + B_j u, cost sum x'Wx + u'Ru, initial states v, decay rate r: minimise lambda such
// that for all j, l, v
//     [ 1   v' ; v  Q_j ] >= 0
//     [ G_j+G_j'-Q_j          .      .         .        ]
//     [ (A_j G_j+B_j M_j)/r   Q_l    .         .        ]  >= 0
//     [ W^(1/2) G_j           0      lambda I  .        ]
//     [ R^(1/2) M_j           0      0         lambda I ]
//     [ G_j+G_j'-Q_j  . ;  M_j     umax^2   ] >= 0           |u| <= umax          (Theorem 2)
//     [ G_j+G_j'-Q_j  . ;  c G_j   ymax^2   ] >= 0           |c x| <= ymax        (Theorem 3)
// Then F_j = M_j G_j^-1, P_j = lambda Q_j^-1, V = x' (sum alpha_j P_j) x and V+ <= r^2 (V - x'Wx - u'Ru). Along
// every trajectory from a convex combination of the v, the sum of costs is at most lambda, and the bounds hold.
//
// The paper divides Q, G and M by lambda; then lambda is in the first inequality and 1 in the others. Its
// bounds are mu^2 lambda and gamma^2 lambda, and a limit in N.m needs a search over mu. In the unknowns
// above, lambda and the limits enter linearly. The limit in N.m is itself an LMI, and one solve gives the
// result to which the search converges. Square roots of W and R avoid their inverses, 1e4 and 1e6.
//
// A temperature-free controller has one F, G, Q for every rule. With `mistaken_share`, the block inequality also
// holds for plant rules i != j under gain j, with W and R times that share. This covers a wrong temperature.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "design/gains/sdp_solver.h"

namespace strainwave {

/// |row x| <= limit for every reachable state.
struct OutputBound {
  Eigen::RowVectorXd row;
  double limit = 0.0;  ///< > 0
};

struct ControllerProblem {
  std::vector<Eigen::MatrixXd> A;               ///< n x n per rule
  std::vector<Eigen::VectorXd> B;               ///< n per rule
  Eigen::VectorXd state_weights;                ///< diagonal of W, n, each > 0
  double input_weight = 0.0;                    ///< R > 0
  std::vector<Eigen::VectorXd> initial_states;  ///< v, n each, at least one that is not zero
  double decay_rate = 1.0;                      ///< r in (0, 1]
  double input_limit = 0.0;                     ///< umax, 0: none
  std::vector<OutputBound> output_bounds;
  bool scheduled = true;  ///< one gain per rule; false: one for all
  /// Share of the stage cost by which V must fall if plant and gain have different rules; 0: no condition.
  double mistaken_share = 0.0;
};

struct ControllerSolution {
  SdpStatus status = SdpStatus::kCrashed;
  /// It is proved that no solution has unknowns below kProvedSize, in units of a single rule's optimum.
  bool impossible = false;
  std::string explanation;
  double lambda = 0.0;
  std::vector<Eigen::RowVectorXd> F;  ///< one per rule if scheduled, else one
  std::vector<Eigen::MatrixXd> P;     ///< as many as F, symmetric
  double violation = 0.0;             ///< of the inequalities in balanced units
};

inline constexpr double kProvedSize = 1e6;

/// Solves in balanced units, x = S z with S = diag(P)^(-1/2). The first solve takes P from the Riccati equation of a middle
/// rule, the second from the first result. The cost is scaled so that lambda is near 1. The units of the states and of the
/// cost therefore do not change the result. If both solves fail, a third one looks for a proof that there is no solution.
ControllerSolution solve_controller(const ControllerProblem& problem, const SdpOptions& options = {});

}  // namespace strainwave
