// SPDX-License-Identifier: BSD-3-Clause
// Local descent in the unit box: one damped Newton step at a time (Levenberg-Marquardt). The curvature is the
// cost's own where it knows one (Gauss-Newton), otherwise it is learned from the gradients met on the way
// (damped BFGS). Offline. Source: Nocedal and Wright, "Numerical Optimization", sections 10.3, 16.7 and 18.3.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace strainwave {

/// A cost and its derivatives at one point.
struct CostSample {
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;  ///< positive semidefinite approximation of the second derivative; 0x0: unknown
};
/// Must be callable from several threads at once.
using GradientCost = std::function<void(const Eigen::VectorXd& x, CostSample& sample)>;

/// A point of the unit box that remembers what it learned on its way.
struct DescentPoint {
  Eigen::VectorXd x;
  CostSample sample;               ///< at x; curvature always filled
  bool curvature_learned = false;  ///< the cost does not supply it
  double damping = 1e-2;           ///< relative to the curvature's diagonal
  bool converged = false;          ///< no step lowers the cost any more
};

/// Evaluates `x` (inside the unit box).
DescentPoint start_descent(const GradientCost& cost, const Eigen::VectorXd& x);

/// One step: the cost never rises. Returns the number of evaluations. Converged: the quadratic model promises
/// less than `tolerance` times the cost, or no damping finds a lower cost.
int descend(const GradientCost& cost, DescentPoint& point, double tolerance);

/// Norm of the gradient without the components that push against the box.
double projected_slope(const DescentPoint& point);

}  // namespace strainwave
