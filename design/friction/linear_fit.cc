// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/linear_fit.h"

namespace strainwave {

namespace {

using Index = Eigen::Index;

constexpr double kFitRidge = 1e-12;

// vec(D) is scaled by the root of the metric's diagonal, so that the parameters' different units do not matter.
Eigen::Vector3d units_of(const Eigen::Matrix3d& metric) {
  return metric.diagonal().cwiseSqrt();
}

}  // namespace

// Products of a few rows and columns: lazyProduct is faster than the blocked kernels.
LinearFit::LinearFit(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
                     LinearConstraint constraint)
    : metric_(metric),
      L_(metric.llt().matrixL()),
      U_(RuleMatrix::Identity(Phi.cols(), Phi.cols())),
      basis_(Phi) {
  const Index m = Phi.cols();
  if (constraint == LinearConstraint::kNonNegativeDescending) {
    U_.triangularView<Eigen::StrictlyUpper>().setOnes();
    for (Index i = 1; i < m; ++i) basis_.col(i) += basis_.col(i - 1);
  }
  gram_ = basis_.transpose().lazyProduct(basis_);
  gram_.diagonal().array() += kFitRidge * gram_.trace();
  gram_factor_.compute(gram_);
  const Eigen::MatrixX3d right = basis_.transpose().lazyProduct(targets.parameters);
  // Without active constraints the metric cancels. All parameters have the same functions, so that three
  // separate problems remain.
  const Eigen::MatrixX3d D = gram_factor_.solve(right);
  constraints_active_ = constraint != LinearConstraint::kNone && D.minCoeff() < 0.0;
  if (constraints_active_) {
    solve_constrained(right);
  } else {
    C_ = U_.lazyProduct(D);
  }
  errors_ = targets.parameters;
  errors_ -= Phi.lazyProduct(C_);
  cost_ = metric_cost(errors_, metric_);
}

void LinearFit::solve_constrained(const Eigen::MatrixX3d& right) {
  const Index m = gram_.rows();
  const Eigen::Vector3d unit = units_of(metric_);
  const Eigen::MatrixX3d weighted = right * metric_ * unit.cwiseInverse().asDiagonal();
  normal_.resize(3 * m, 3 * m);
  SmallVector g(3 * m);
  for (Index p = 0; p < 3; ++p) {
    g.segment(p * m, m) = weighted.col(p);
    for (Index q = 0; q < 3; ++q)
      normal_.block(p * m, q * m, m, m) = metric_(p, q) / (unit(p) * unit(q)) * gram_;
  }
  const NonnegativeSolution solution = solve_nonnegative(normal_, g);
  free_ = solution.free;
  Eigen::MatrixX3d D(m, 3);
  for (Index p = 0; p < 3; ++p) D.col(p) = solution.x.segment(p * m, m) / unit(p);
  C_ = U_ * D;
}

Eigen::VectorXd LinearFit::gradient(const Eigen::MatrixXd& change) const {
  const Eigen::MatrixX3d whitened = errors_.lazyProduct(L_);
  return -(change.transpose() * whitened.reshaped());
}

Eigen::MatrixXd LinearFit::curvature(const Eigen::MatrixXd& change) const {
  const Index n = errors_.rows();
  const Index m = U_.cols();
  const Index count = change.cols();
  Eigen::MatrixXd result = change.transpose().lazyProduct(change);
  Eigen::MatrixXd coupling(3 * m, count);
  for (Index p = 0; p < 3; ++p) {
    coupling.middleRows(p * m, m) = basis_.transpose().lazyProduct(change.middleRows(p * n, n));
  }
  if (!constraints_active_) {
    for (Index p = 0; p < 3; ++p) gram_factor_.matrixL().solveInPlace(coupling.middleRows(p * m, m));
    result -= coupling.transpose().lazyProduct(coupling);
    return result;
  }
  const Eigen::Vector3d unit = units_of(metric_);
  Eigen::MatrixXd free_coupling = Eigen::MatrixXd::Zero(free_.count, count);
  for (Index a = 0; a < free_.count; ++a) {
    const Index p = free_[a] / m;
    for (Index q = 0; q < 3; ++q)
      free_coupling.row(a) += L_(p, q) / unit(p) * coupling.row(q * m + free_[a] % m);
  }
  const Eigen::LLT<SmallMatrix> factor(free_part(normal_, free_));
  factor.matrixL().solveInPlace(free_coupling);
  result -= free_coupling.transpose().lazyProduct(free_coupling);
  return result;
}

}  // namespace strainwave
