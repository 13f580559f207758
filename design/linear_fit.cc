#include "design/linear_fit.h"

namespace strainwave {

namespace {

using Index = Eigen::Index;

constexpr double kRidge = 1e-12;

// vec(D) is scaled by the root of the metric's diagonal, so that the parameters' different units do not
// matter.
Eigen::Vector3d units_of(const Eigen::Matrix3d& metric) {
  return metric.diagonal().cwiseSqrt();
}

}  // namespace

LinearFit::LinearFit(const FitTargets& targets, const Eigen::Matrix3d& metric, const Eigen::MatrixXd& Phi,
                     LinearConstraint constraint)
    : metric_(metric), U_(Eigen::MatrixXd::Identity(Phi.cols(), Phi.cols())) {
  const Index m = Phi.cols();
  if (constraint == LinearConstraint::kNonNegativeDescending)
    U_.triangularView<Eigen::StrictlyUpper>().setOnes();
  basis_.noalias() = Phi * U_;
  Eigen::MatrixXd gram = basis_.transpose() * basis_;
  gram.diagonal().array() += kRidge * gram.trace();
  const Eigen::MatrixX3d right = basis_.transpose() * targets.parameters;
  const Eigen::Vector3d unit = units_of(metric);
  normal_.resize(3 * m, 3 * m);
  for (Index p = 0; p < 3; ++p) {
    for (Index q = 0; q < 3; ++q)
      normal_.block(p * m, q * m, m, m) = metric(p, q) / (unit(p) * unit(q)) * gram;
  }
  // Without active constraints the metric cancels: with the same functions for every parameter, three
  // separate problems.
  const Eigen::MatrixX3d D = gram.llt().solve(right);
  free_ = all_free(3 * m);
  C_ = U_ * D;
  if (constraint != LinearConstraint::kNone && D.minCoeff() < 0.0) solve_constrained(gram, right);
  errors_ = targets.parameters - Phi * C_;
  cost_ = metric_cost(errors_, metric_);
}

void LinearFit::solve_constrained(const Eigen::MatrixXd& gram, const Eigen::MatrixX3d& right) {
  const Index m = gram.rows();
  const Eigen::Vector3d unit = units_of(metric_);
  const Eigen::MatrixX3d weighted = right * metric_ * unit.cwiseInverse().asDiagonal();
  SmallVector g(3 * m);
  for (Index p = 0; p < 3; ++p) g.segment(p * m, m) = weighted.col(p);
  const NonnegativeSolution solution = solve_nonnegative(normal_, g);
  free_ = solution.free;
  Eigen::MatrixX3d D(m, 3);
  for (Index p = 0; p < 3; ++p) D.col(p) = solution.x.segment(p * m, m) / unit(p);
  C_ = U_ * D;
}

Eigen::MatrixXd LinearFit::curvature_loss(const Eigen::MatrixXd& phi_by_p_times_C) const {
  const Index n = errors_.rows();
  const Index m = U_.cols();
  const Index count = phi_by_p_times_C.cols();
  const Eigen::Vector3d unit = units_of(metric_);
  Eigen::MatrixXd coupling(3 * m, count);
  for (Index p = 0; p < 3; ++p) {
    coupling.middleRows(p * m, m).noalias() =
        basis_.transpose() * phi_by_p_times_C.middleRows(p * n, n) / unit(p);
  }
  Eigen::MatrixXd free_coupling(free_.count, count);
  for (Index a = 0; a < free_.count; ++a) free_coupling.row(a) = coupling.row(free_[a]);
  const SmallMatrix normal = free_part(normal_, free_);
  const Eigen::LLT<SmallMatrix> factor(normal);
  factor.matrixL().solveInPlace(free_coupling);
  return free_coupling.transpose() * free_coupling;
}

}  // namespace strainwave
