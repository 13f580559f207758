// SPDX-License-Identifier: BSD-3-Clause
// Fits fuzzy friction whose curve over temperature never rises. Falling rules alone are not enough: normalised
// memberships of different widths may return to a colder rule where a narrower rule between has ended. Offline.
//
//   minimise  metric_cost(parameters - Phi C)   subject to   C >= 0,  C_1 >= C_2 >= ...,  p(T_k) >= p(T_k+1)
// over a grid T_k of the range. The active constraints are found one by one. Their multipliers solve a non-negative
// least-squares problem (the dual of a quadratic program; Boyd and Vandenberghe, Convex Optimization, 5.2).
#pragma once

#include <optional>

#include "design/friction/friction_fit.h"

namespace strainwave {

/// The best consequents for given memberships. The range may be wider than the data's. Returns nothing if the
/// search does not end within many times the steps that a well-posed fit needs.
std::optional<FuzzyFit> fit_descending_curve(const FitProblem& problem, const Eigen::VectorXd& center_C,
                                             const Eigen::VectorXd& width_C, double min_C, double max_C);

/// The largest rise of a curve above its minimum at colder temperatures.
struct CurveRise {
  double share = 0.0;  ///< relative to that minimum
  double temperature_C = 0.0;
  int parameter = 0;  ///< 0 static, 1 Coulomb, 2 viscous
};
CurveRise worst_rise(const FuzzyFit& fit, double min_C, double max_C);

}  // namespace strainwave
