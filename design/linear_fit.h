// The linear half of a friction fit: parameters that are combinations Phi C of known functions of
// temperature. Variable projection: the nonlinear half is fitted over the cost that remains here. Offline.
// Source: Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973); Kaufman, BIT 15 (1975) for the curvature.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "design/friction_metric.h"
#include "design/nonnegative_least_squares.h"

namespace strainwave {

/// Shape of the physical constraint on C, one column per friction parameter.
enum class LinearConstraint {
  kNone,
  kNonNegative,            ///< C >= 0
  kNonNegativeDescending,  ///< each column: C_1 >= C_2 >= ... >= 0
};

/// minimise over C: metric_cost(parameters - Phi C). Phi: n x m, m <= 16. A relative ridge of 1e-12 keeps
/// functions that coincide apart; it does not move a well-posed fit.
class LinearFit {
 public:
  LinearFit(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
            LinearConstraint constraint);

  const Eigen::MatrixX3d& C() const { return C_; }            ///< m x 3
  const Eigen::MatrixX3d& errors() const { return errors_; }  ///< parameters - Phi C, n x 3
  double cost() const { return cost_; }
  /// d cost / d Phi, n x m. C's own change with Phi does not count: C is optimal (envelope theorem), also
  /// where constraints are active.
  Eigen::MatrixXd cost_by_phi() const { return -(errors_ * metric_) * C_.transpose(); }
  /// What to subtract from A'A, A = d(Phi C)/d p in the metric, because C follows p: Gauss-Newton's curvature
  /// of the projected cost. Column k of `phi_by_p_times_C` is d(Phi)/d p_k C M, n x 3 stacked by columns.
  Eigen::MatrixXd curvature_loss(const Eigen::MatrixXd& phi_by_p_times_C) const;

 private:
  void solve_constrained(const Eigen::MatrixXd& gram, const Eigen::MatrixX3d& right);

  Eigen::Matrix3d metric_;
  Eigen::MatrixXd U_;      // C = U D
  Eigen::MatrixXd basis_;  // Phi U
  SmallMatrix normal_;     // of vec(D), 3m x 3m
  FreeUnknowns free_;      // of vec(D)
  Eigen::MatrixX3d C_;
  Eigen::MatrixX3d errors_;
  double cost_ = 0.0;
};

}  // namespace strainwave
