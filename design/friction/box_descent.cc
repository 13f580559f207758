// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/box_descent.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

using Index = Eigen::Index;

constexpr double kFirstMove = 0.1;    // of the box, before any curvature is known
constexpr double kLargestMove = 0.3;  // of the box: the quadratic model is local
constexpr double kMinDamping = 1e-9;
constexpr double kMaxDamping = 1e6;
constexpr int kMaxTrials = 10;  // in one step

bool pushes_out(const DescentPoint& point, Index i) {
  const double slope = point.sample.gradient(i);
  return (point.x(i) <= 0.0 && slope > 0.0) || (point.x(i) >= 1.0 && slope < 0.0);
}

Eigen::VectorXd free_gradient(const DescentPoint& point) {
  Eigen::VectorXd gradient = point.sample.gradient;
  for (Index i = 0; i < gradient.size(); ++i) {
    if (pushes_out(point, i)) gradient(i) = 0.0;
  }
  return gradient;
}

// The step to the minimum of the damped quadratic model. Components at a bound stay there if the descent
// would leave the box.
Eigen::VectorXd model_step(const DescentPoint& point, const Eigen::VectorXd& gradient) {
  const Index n = gradient.size();
  Eigen::MatrixXd B = point.sample.curvature;
  const double floor = 1e-8 * std::max(B.diagonal().maxCoeff(), 1e-300);
  for (Index i = 0; i < n; ++i) B(i, i) += point.damping * std::max(B(i, i), floor) + floor * 1e-4;
  for (Index i = 0; i < n; ++i) {
    if (!pushes_out(point, i)) continue;
    B.row(i).setZero();
    B.col(i).setZero();
    B(i, i) = 1.0;
  }
  Eigen::VectorXd move = -B.ldlt().solve(gradient);
  const double largest = move.cwiseAbs().maxCoeff();
  if (largest > kLargestMove) move *= kLargestMove / largest;
  return move;
}

// Damped BFGS update of the curvature B, which stays positive definite for every s and y.
void learn(Eigen::MatrixXd& B, const Eigen::VectorXd& s, const Eigen::VectorXd& y) {
  const Eigen::VectorXd Bs = B * s;
  const double sBs = s.dot(Bs);
  if (!(sBs > 0.0)) return;
  const double sy = s.dot(y);
  const double theta = sy >= 0.2 * sBs ? 1.0 : 0.8 * sBs / (sBs - sy);
  const Eigen::VectorXd r = theta * y + (1.0 - theta) * Bs;
  B += r * r.transpose() / s.dot(r) - Bs * Bs.transpose() / sBs;
}

}  // namespace

DescentPoint start_descent(const GradientCost& cost, const Eigen::VectorXd& x) {
  DescentPoint point;
  point.x = x;
  cost(point.x, point.sample);
  point.curvature_learned = point.sample.curvature.size() == 0;
  if (point.curvature_learned) {
    const double scale = std::max(free_gradient(point).norm(), 1e-300) / kFirstMove;
    point.sample.curvature = scale * Eigen::MatrixXd::Identity(x.size(), x.size());
  }
  return point;
}

int descend(const GradientCost& cost, DescentPoint& point, double tolerance) {
  const Eigen::VectorXd gradient = free_gradient(point);
  CostSample trial;
  for (int trials = 1; trials <= kMaxTrials; ++trials) {
    const Eigen::VectorXd x = (point.x + model_step(point, gradient)).cwiseMax(0.0).cwiseMin(1.0);
    const Eigen::VectorXd s = x - point.x;
    const double promise = -(gradient.dot(s) + 0.5 * s.dot(point.sample.curvature * s));
    if (!(-gradient.dot(s) > tolerance * std::abs(point.sample.value)) || point.damping > kMaxDamping) {
      point.converged = true;
      return trials - 1;
    }
    cost(x, trial);
    const double gain = point.sample.value - trial.value;
    if (gain > 0.0) {
      const double quality = promise > 0.0 ? gain / promise : 0.0;
      if (quality > 0.75) point.damping = std::max(0.2 * point.damping, kMinDamping);
      if (quality < 0.25) point.damping *= 3.0;
      if (point.curvature_learned) {
        trial.curvature = point.sample.curvature;
        learn(trial.curvature, s, trial.gradient - point.sample.gradient);
      }
      point.x = x;
      std::swap(point.sample, trial);
      return trials;
    }
    point.damping = 5.0 * std::max(point.damping, kMinDamping);
  }
  return kMaxTrials;
}

double projected_slope(const DescentPoint& point) {
  return free_gradient(point).norm();
}

}  // namespace strainwave
