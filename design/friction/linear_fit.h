// SPDX-License-Identifier: BSD-3-Clause
// The linear half of a friction fit: parameters that are combinations Phi C of known functions of
// temperature. The nonlinear half minimises the cost that remains here (variable projection). Offline.
// Source: Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973); Kaufman, BIT 15 (1975) for the curvature.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "design/friction/friction_metric.h"
#include "design/friction/nonnegative_least_squares.h"

namespace strainwave {

/// Shape of the physical constraint on C, one column per friction parameter.
enum class LinearConstraint {
  kNone,
  kNonNegative,            ///< C >= 0
  kNonNegativeDescending,  ///< each column: C_1 >= C_2 >= ... >= 0
};

/// minimise over C: metric_cost(parameters - Phi C). Phi: n x m, m <= 16. A relative ridge of 1e-12 makes the
/// fit unique if functions coincide. It does not change a well-posed fit.
///
/// "Whitened": multiplied by L from the right, metric = L L', so that the cost is half a plain sum of squares.
class LinearFit {
 public:
  LinearFit(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
            LinearConstraint constraint);

  const Eigen::MatrixX3d& coefficients() const { return C_; }  ///< C, m x 3
  const Eigen::MatrixX3d& errors() const { return errors_; }   ///< parameters - Phi C, n x 3
  double cost() const { return cost_; }
  const Eigen::Matrix3d& whitening() const { return L_; }  ///< L

  /// Derivative of the cost over parameters p of Phi, and Gauss-Newton's approximation of the second derivative.
  /// Column k of `change` is d(Phi)/d p_k C L, n x 3 stacked by columns. The gradient ignores the change of C,
  /// because C is optimal even with active constraints (envelope theorem). The curvature projects it out.
  Eigen::VectorXd gradient(const Eigen::MatrixXd& change) const;
  Eigen::MatrixXd curvature(const Eigen::MatrixXd& change) const;

 private:
  using RuleMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;

  void solve_constrained(const Eigen::MatrixX3d& right);

  Eigen::Matrix3d metric_;
  Eigen::Matrix3d L_;
  RuleMatrix U_;           // C = U D
  Eigen::MatrixXd basis_;  // Phi U
  RuleMatrix gram_;        // basis' basis
  Eigen::LLT<RuleMatrix> gram_factor_;
  bool constraints_active_ = false;
  SmallMatrix normal_;  // of vec(D), 3m x 3m; set only if constraints are active, as is free_
  FreeUnknowns free_;
  Eigen::MatrixX3d C_;
  Eigen::MatrixX3d errors_;
  double cost_ = 0.0;
};

}  // namespace strainwave
