#include "design/linear_fit.h"

#include <Eigen/Cholesky>

#include "design/nonnegative_least_squares.h"

namespace strainwave {

namespace {

constexpr double kRidge = 1e-12;

// With the same functions for every parameter the metric cancels: three ordinary least-squares problems.
Eigen::MatrixX3d unconstrained(const Eigen::MatrixXd& gram, const Eigen::MatrixX3d& right) {
  return gram.llt().solve(right);
}

// In the unknowns D >= 0, C = U D. The metric couples the columns once constraints are active.
Eigen::MatrixX3d constrained(const Eigen::MatrixXd& gram, const Eigen::MatrixX3d& right,
                             const Eigen::Matrix3d& metric, const Eigen::MatrixXd& U) {
  const Eigen::Index m = gram.rows();
  // Unit diagonal of the metric: the three parameters differ by 1e3 in their units.
  const Eigen::Vector3d unit = metric.diagonal().cwiseSqrt();
  const Eigen::Matrix3d scaled = unit.cwiseInverse().asDiagonal() * metric * unit.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd gram_D = U.transpose() * gram * U;
  const Eigen::MatrixX3d right_D = U.transpose() * right * unit.asDiagonal() * scaled;
  SmallMatrix H(3 * m, 3 * m);
  SmallVector g(3 * m);
  for (Eigen::Index p = 0; p < 3; ++p) {
    g.segment(p * m, m) = right_D.col(p);
    for (Eigen::Index q = 0; q < 3; ++q) H.block(p * m, q * m, m, m) = scaled(p, q) * gram_D;
  }
  const SmallVector d = solve_nonnegative(H, g);
  Eigen::MatrixX3d D(m, 3);
  for (Eigen::Index p = 0; p < 3; ++p) D.col(p) = d.segment(p * m, m) / unit(p);
  return U * D;
}

}  // namespace

LinearFit fit_linear(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
                     LinearConstraint constraint) {
  const Eigen::Index m = Phi.cols();
  Eigen::MatrixXd gram = Phi.transpose() * Phi;
  gram.diagonal().array() += kRidge * gram.trace();
  const Eigen::MatrixX3d right = Phi.transpose() * targets.parameters;
  LinearFit fit;
  fit.C = unconstrained(gram, right);
  if (constraint != LinearConstraint::kNone) {
    Eigen::MatrixXd U = Eigen::MatrixXd::Identity(m, m);
    if (constraint == LinearConstraint::kNonNegativeDescending)
      U.triangularView<Eigen::StrictlyUpper>().setOnes();
    const Eigen::MatrixX3d D = U.triangularView<Eigen::Upper>().solve(fit.C);
    if (D.minCoeff() < 0.0) fit.C = constrained(gram, right, metric, U);
  }
  const Eigen::MatrixX3d errors = targets.parameters - Phi * fit.C;
  fit.cost = metric_cost(errors, metric);
  fit.cost_by_phi = -(errors * metric) * fit.C.transpose();
  return fit;
}

}  // namespace strainwave
