// SPDX-License-Identifier: BSD-3-Clause
// Local descent in the unit box by one damped Newton step at a time (Levenberg-Marquardt). The cost may
// supply its curvature (Gauss-Newton); otherwise the descent learns it from successive gradients (damped
// BFGS). Offline. Source: Nocedal and Wright, "Numerical Optimization", sections 10.3, 16.7 and 18.3.
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

/// A point of the unit box with the state of its descent.
struct DescentPoint {
  Eigen::VectorXd x;
  CostSample sample;               ///< at x; curvature always filled
  bool curvature_learned = false;  ///< the cost does not supply it
  double damping = 1e-2;           ///< relative to the curvature's diagonal
  bool converged = false;          ///< no step lowers the cost any more
};

/// Evaluates `x` (inside the unit box).
DescentPoint start_descent(const GradientCost& cost, const Eigen::VectorXd& x);

/// Takes one step, which never raises the cost, and returns the number of evaluations. A point has converged
/// if its gradient predicts a gain below `tolerance` times the cost, or no damping lowers the cost.
int descend(const GradientCost& cost, DescentPoint& point, double tolerance);

/// Norm of the gradient without the components that push against the box.
double projected_slope(const DescentPoint& point);

}  // namespace strainwave
