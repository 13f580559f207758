// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"

namespace strainwave {

namespace {

using Index = Eigen::Index;

// Phi = softmax of a = -((T - c)/s)^2 along each row, so that d(Phi C)_k / d a_kj = Phi_kj (C_j - (Phi C)_k).
void differentiate(const FitProblem& problem, const LinearFit& linear, const Eigen::MatrixXd& Phi,
                   const std::vector<Index>& order, FuzzyFit& fit) {
  const Index m = Phi.cols();
  const Index n = Phi.rows();
  const Eigen::MatrixX3d predicted =
      (problem.targets.parameters - linear.errors()).lazyProduct(linear.whitening());
  const Eigen::MatrixX3d consequents = linear.coefficients().lazyProduct(linear.whitening());
  Eigen::MatrixXd change(3 * n, 2 * m);
  Eigen::ArrayXd distance(n), by_center(n);
  for (Index j = 0; j < m; ++j) {
    const double width = fit.width_C(j);
    distance = (problem.targets.temperature_C.array() - fit.center_C(j)) / width;
    by_center = Phi.col(j).array() * distance * (2.0 / width);
    const Index original = order[static_cast<std::size_t>(j)];
    for (Index p = 0; p < 3; ++p) {
      auto by_this_center = change.col(original).segment(p * n, n);
      by_this_center = by_center * (consequents(j, p) - predicted.col(p).array());
      change.col(m + original).segment(p * n, n) = by_this_center.array() * distance;
    }
  }
  fit.gradient = linear.gradient(change);
  fit.curvature = linear.curvature(change);
}

FrictionParameters joint_parameters(const Eigen::RowVector3d& motor, double gear_ratio) {
  return {joint_torque_Nm_from_motor_Ncm(motor(0), gear_ratio),
          joint_torque_Nm_from_motor_Ncm(motor(1), gear_ratio),
          joint_viscous_Nms_rad_from_motor_Ncm_per_rpm(motor(2), gear_ratio)};
}

}  // namespace

Eigen::MatrixXd normalised_memberships(const Eigen::VectorXd& temperature_C, const Eigen::VectorXd& center_C,
                                       const Eigen::VectorXd& width_C) {
  Eigen::MatrixXd Phi(temperature_C.size(), center_C.size());
  for (Index i = 0; i < center_C.size(); ++i) {
    Phi.col(i) = -((temperature_C.array() - center_C(i)) / width_C(i)).square();
  }
  Phi.colwise() -= Eigen::VectorXd(Phi.rowwise().maxCoeff());
  Phi = Phi.array().exp();
  Phi.array().colwise() /= Eigen::ArrayXd(Phi.rowwise().sum());
  return Phi;
}

ExponentialFit fit_exponential_at(const FitProblem& problem, double decay_C) {
  const Eigen::VectorXd& T = problem.targets.temperature_C;
  ExponentialFit fit;
  fit.reference_C = T(0);
  fit.decay_C = decay_C;
  const Eigen::ArrayXd distance = T.array() - fit.reference_C;
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Ones(T.size(), 2);
  Phi.col(1) = (-distance / decay_C).exp();
  const LinearFit linear(problem.targets, problem.metric, Phi,
                         problem.physical ? LinearConstraint::kNonNegative : LinearConstraint::kNone);
  fit.p0 = linear.coefficients().row(0);
  fit.p1 = linear.coefficients().row(1);
  fit.cost = linear.cost();
  const Eigen::ArrayXd by_decay = Phi.col(1).array() * distance / (decay_C * decay_C);
  const Eigen::MatrixX3d change = by_decay.matrix() * (fit.p1 * linear.whitening());
  const Eigen::MatrixXd stacked = change.reshaped();
  fit.gradient = linear.gradient(stacked)(0);
  fit.curvature = linear.curvature(stacked)(0, 0);
  return fit;
}

ExponentialFit fit_exponential(const FitProblem& problem, double low_C, double high_C) {
  constexpr int kScan = 200;
  const double ratio = std::pow(high_C / low_C, 1.0 / kScan);
  double best = low_C;
  double best_cost = fit_exponential_at(problem, low_C).cost;
  for (int i = 1; i <= kScan; ++i) {
    const double candidate = low_C * std::pow(ratio, i);
    const double cost = fit_exponential_at(problem, candidate).cost;
    if (cost < best_cost) {
      best_cost = cost;
      best = candidate;
    }
  }
  double a = std::max(low_C, best / ratio);
  double b = std::min(high_C, best * ratio);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (b - a > 1e-9 * b) {
    const double left = b - golden * (b - a);
    const double right = a + golden * (b - a);
    if (fit_exponential_at(problem, left).cost < fit_exponential_at(problem, right).cost) {
      b = right;
    } else {
      a = left;
    }
  }
  return fit_exponential_at(problem, 0.5 * (a + b));
}

FuzzyFit fit_consequents(const FitProblem& problem, const Eigen::VectorXd& center_C,
                         const Eigen::VectorXd& width_C) {
  const Index m = center_C.size();
  std::vector<Index> order(static_cast<std::size_t>(m));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&center_C](Index a, Index b) { return center_C(a) < center_C(b); });
  FuzzyFit fit;
  fit.center_C = center_C(order);
  fit.width_C = width_C(order);
  const Eigen::VectorXd& T = problem.targets.temperature_C;
  const Eigen::MatrixXd Phi = normalised_memberships(T, fit.center_C, fit.width_C);
  const LinearFit linear(
      problem.targets, problem.metric, Phi,
      problem.physical ? LinearConstraint::kNonNegativeDescending : LinearConstraint::kNone);
  fit.consequents = linear.coefficients();
  fit.cost = linear.cost();
  differentiate(problem, linear, Phi, order, fit);
  return fit;
}

Memberships graded_memberships(Index count, double min_C, double max_C) {
  constexpr double kGrowth = 1.6;
  constexpr double kOverlap = 0.8;
  Eigen::VectorXd gap(count - 1);
  for (Index i = 0; i < count - 1; ++i) gap(i) = std::pow(kGrowth, static_cast<double>(i));
  gap *= (max_C - min_C) / gap.sum();
  Memberships memberships{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const double before = gap(std::max<Index>(i - 1, 0));
    const double after = gap(std::min(i, count - 2));
    memberships.center_C(i) = min_C + gap.head(i).sum();
    memberships.width_C(i) = kOverlap * std::sqrt(before * after);
  }
  return memberships;
}

Eigen::MatrixX3d predict(const ExponentialFit& fit, const Eigen::VectorXd& temperature_C) {
  const Eigen::VectorXd decay = (-(temperature_C.array() - fit.reference_C) / fit.decay_C).exp();
  return Eigen::VectorXd::Ones(temperature_C.size()) * fit.p0 + decay * fit.p1;
}

Eigen::MatrixX3d predict(const FuzzyFit& fit, const Eigen::VectorXd& temperature_C) {
  return normalised_memberships(temperature_C, fit.center_C, fit.width_C) * fit.consequents;
}

ExponentialTemperatureLaw to_joint_side(const ExponentialFit& fit, double gear_ratio) {
  return {joint_parameters(fit.p0, gear_ratio), joint_parameters(fit.p1, gear_ratio), fit.reference_C,
          fit.decay_C};
}

FuzzyFriction to_joint_side(const FuzzyFit& fit, double gear_ratio, double temperature_min_C,
                            double temperature_max_C) {
  FuzzyFriction friction;
  friction.rule_count = static_cast<std::int32_t>(fit.center_C.size());
  for (Index i = 0; i < fit.center_C.size(); ++i) {
    // Rules may share a centre, but a table requires ascending ones. One unit in the last place is negligible.
    double center_C = fit.center_C(i);
    if (i > 0)
      center_C =
          std::max(center_C, std::nextafter(friction.rules[static_cast<std::size_t>(i - 1)].center_C, 1e9));
    friction.rules[static_cast<std::size_t>(i)] = {center_C, fit.width_C(i),
                                                   joint_parameters(fit.consequents.row(i), gear_ratio)};
  }
  friction.velocity = source_velocity_memberships(gear_ratio);
  friction.temperature_min_C = temperature_min_C;
  friction.temperature_max_C = temperature_max_C;
  return friction;
}

VelocityMemberships source_velocity_memberships(double gear_ratio) {
  const auto joint = [gear_ratio](double motor_rpm) {
    return joint_velocity_rad_s_from_motor_rpm(motor_rpm, gear_ratio);
  };
  return {joint(0.0), joint(40.0), joint(40.0), joint(80.0)};
}

}  // namespace strainwave
