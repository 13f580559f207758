// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_update.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "design/friction/nonnegative_least_squares.h"

namespace strainwave {

namespace {

using Index = Eigen::Index;

// Friction with a prior of 0 may still be positive. Its deviation is this share of the largest over temperature.
constexpr double kLeastShare = 0.02;
// Rules that can hardly be distinguished also stay near their own prior value, with this deviation.
constexpr double kRuleDeviation = 10.0;  // in units of `own`
constexpr Index kGrid = 51;              // temperatures over the range

Eigen::VectorXd parameters_of(const FuzzyFriction& friction) {
  const Index m = friction.rule_count;
  Eigen::VectorXd c(3 * m);
  for (Index i = 0; i < m; ++i) {
    const FrictionParameters& rule = friction.rules[static_cast<std::size_t>(i)].friction;
    c(i) = rule.static_Nm - rule.coulomb_Nm;
    c(m + i) = rule.coulomb_Nm;
    c(2 * m + i) = rule.viscous_Nms_rad;
  }
  return c;
}

void set_parameters(FuzzyFriction& friction, const Eigen::VectorXd& c) {
  const Index m = friction.rule_count;
  for (Index i = 0; i < m; ++i)
    friction.rules[static_cast<std::size_t>(i)].friction = {c(i) + c(m + i), c(m + i), c(2 * m + i)};
}

/// Memberships at temperatures over the whole range, one row per temperature.
Eigen::MatrixXd memberships_over_range(const FuzzyFriction& friction) {
  const Index m = friction.rule_count;
  Eigen::MatrixXd Phi(kGrid, m);
  for (Index k = 0; k < kGrid; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(kGrid - 1);
    const TemperatureWeights weights =
        friction.weights(std::lerp(friction.temperature_min_C, friction.temperature_max_C, share));
    Phi.row(k) = Eigen::RowVectorXd::Map(weights.weight.data(), m);
  }
  return Phi;
}

/// Q of one kind of parameter. It is the covariance after seeing the blended parameter over the whole range
/// with a relative deviation of 1, as many times as there are rules.
Eigen::MatrixXd own_covariance(const Eigen::VectorXd& c0, const Eigen::MatrixXd& Phi) {
  const Index m = c0.size();
  const Eigen::VectorXd blended = Phi * c0;
  const double least = kLeastShare * std::max(blended.cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::VectorXd size = blended.cwiseAbs().cwiseMax(least);
  const Eigen::MatrixXd seen = size.cwiseInverse().asDiagonal() * Phi;
  Eigen::MatrixXd precision = static_cast<double>(m) / static_cast<double>(kGrid) * seen.transpose() * seen;
  precision.diagonal() += (kRuleDeviation * c0.cwiseAbs().cwiseMax(least)).cwiseAbs2().cwiseInverse();
  return precision.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
}

Eigen::MatrixXd prior_covariance(const FuzzyFriction& prior, const Eigen::VectorXd& c0,
                                 const UpdateWeights& weights) {
  const Index m = prior.rule_count;
  const Eigen::MatrixXd Phi = memberships_over_range(prior);
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(3 * m, 3 * m);
  for (Index kind = 0; kind < 3; ++kind) {
    const Eigen::VectorXd block = c0.segment(kind * m, m);
    P.block(kind * m, kind * m, m, m) = weights.common * weights.common * block * block.transpose() +
                                        weights.own * weights.own * own_covariance(block, Phi);
  }
  return P;
}

/// The physical parameters are c = U d with d >= 0. Those that fall with temperature are sums from the warm end.
Eigen::MatrixXd physical_basis(Index m) {
  Eigen::MatrixXd U = Eigen::MatrixXd::Identity(3 * m, 3 * m);
  for (Index kind = 1; kind < 3; ++kind)
    U.block(kind * m, kind * m, m, m).triangularView<Eigen::StrictlyUpper>().setOnes();
  return U;
}

/// minimise 1/2 c'Hc - g'c over physical c.
Eigen::VectorXd solve_physical(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, Index m) {
  const Eigen::MatrixXd U = physical_basis(m);
  Eigen::MatrixXd normal = U.transpose() * H * U;
  // Values in N m and in N m s/rad differ in size, so that each unknown is scaled by its own curvature.
  const Eigen::VectorXd unit = normal.diagonal().cwiseSqrt().cwiseInverse();
  normal = unit.asDiagonal() * normal * unit.asDiagonal();
  const Eigen::VectorXd right = unit.asDiagonal() * (U.transpose() * g);
  const NonnegativeSolution solution = solve_nonnegative(SmallMatrix(normal), SmallVector(right));
  return U * (unit.asDiagonal() * Eigen::VectorXd(solution.x));
}

}  // namespace

FrictionUpdate::FrictionUpdate(const FuzzyFriction& prior, const StribeckShape& shape,
                               const std::vector<SteadyPoint>& points, double noise_Nm,
                               const UpdateWeights& weights)
    : shape_(shape), friction_(prior) {
  const Index m = prior.rule_count;
  const Eigen::VectorXd c0 = parameters_of(prior);
  const Eigen::LDLT<Eigen::MatrixXd> P0(prior_covariance(prior, c0, weights));
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(3 * m, 3 * m);
  Eigen::MatrixXd H = P0.solve(identity);
  Eigen::VectorXd g = P0.solve(c0);
  for (const SteadyPoint& point : points) {
    const Eigen::RowVectorXd a = row(point.temperature_C, point.speed_rad_s);
    const double relative_Nm = weights.torque_uncertainty * point.friction_Nm;
    const FrictionParameters known = prior.blend(prior.weights(point.temperature_C));
    const double speed_Nm = ripple_Nm(shape, known.static_Nm - known.coulomb_Nm, point);
    const double weight = 1.0 / (noise_Nm * noise_Nm + relative_Nm * relative_Nm + speed_Nm * speed_Nm);
    H += weight * a.transpose() * a;
    g += weight * point.friction_Nm * a.transpose();
  }
  H = (0.5 * (H + H.transpose())).eval();
  parameters_ = solve_physical(H, g, m);
  covariance_ = H.ldlt().solve(identity);
  set_parameters(friction_, parameters_);
}

Eigen::RowVectorXd FrictionUpdate::row(double temperature_C, double speed_rad_s) const {
  const Index m = friction_.rule_count;
  const TemperatureWeights weights = friction_.weights(temperature_C);
  const Eigen::RowVectorXd phi = Eigen::RowVectorXd::Map(weights.weight.data(), m);
  const Eigen::RowVector3d speed = friction_row(shape_, speed_rad_s);
  Eigen::RowVectorXd a(3 * m);
  a << speed(0) * phi, speed(1) * phi, speed(2) * phi;
  return a;
}

Interval FrictionUpdate::friction_Nm(double temperature_C, double speed_rad_s) const {
  const Eigen::RowVectorXd a = row(temperature_C, speed_rad_s);
  return {a.dot(parameters_), std::sqrt(a * covariance_ * a.transpose())};
}

}  // namespace strainwave
