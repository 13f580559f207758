// The linear half of a friction fit: parameters that are combinations Phi C of known functions of
// temperature. Variable projection: the nonlinear half is fitted over the cost that remains here. Offline.
#pragma once

#include <Eigen/Core>

#include "design/friction_metric.h"

namespace strainwave {

/// Shape of the physical constraint on C, one column per friction parameter.
enum class LinearConstraint {
  kNone,
  kNonNegative,            ///< C >= 0
  kNonNegativeDescending,  ///< each column: C_1 >= C_2 >= ... >= 0
};

struct LinearFit {
  Eigen::MatrixX3d C;           ///< m x 3
  double cost = 0.0;            ///< metric_cost of parameters - Phi C
  Eigen::MatrixXd cost_by_phi;  ///< d cost / d Phi, n x m, at the optimal C (envelope theorem: C's own change
                                ///< does not count)
};

/// minimise over C: metric_cost(parameters - Phi C). Phi: n x m, m <= 16. A relative ridge of 1e-12 keeps
/// functions that coincide apart; it does not move a well-posed fit.
LinearFit fit_linear(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
                     LinearConstraint constraint);

}  // namespace strainwave
