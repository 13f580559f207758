// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/box_descent.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

// Rosenbrock's valley with its minimum 0 at (0.75, 0.75) of the unit box. It provides no curvature.
void rosenbrock(const Eigen::VectorXd& x, CostSample& sample) {
  const double a = 4.0 * x(0) - 2.0, b = 4.0 * x(1) - 2.0;
  sample.value = 100.0 * std::pow(b - a * a, 2) + std::pow(1.0 - a, 2);
  sample.gradient = 4.0 * Eigen::Vector2d(-400.0 * a * (b - a * a) - 2.0 * (1.0 - a), 200.0 * (b - a * a));
}

DescentPoint run(const GradientCost& cost, const Eigen::VectorXd& start, int& evaluations) {
  DescentPoint point = start_descent(cost, start);
  evaluations = 1;
  for (int i = 0; i < 2000 && !point.converged; ++i) {
    const double before = point.sample.value;
    evaluations += descend(cost, point, 1e-14);
    EXPECT_LE(point.sample.value, before);
    EXPECT_TRUE((point.x.array() >= 0.0).all() && (point.x.array() <= 1.0).all());
  }
  return point;
}

TEST(BoxDescent, FollowsACurvedValleyWithLearnedCurvature) {
  int evaluations = 0;
  const DescentPoint point = run(rosenbrock, Eigen::Vector2d(0.2, 0.75), evaluations);
  EXPECT_NEAR(point.x(0), 0.75, 1e-4);
  EXPECT_NEAR(point.x(1), 0.75, 1e-4);
  EXPECT_LT(evaluations, 300);
}

TEST(BoxDescent, StopsAtTheBorderWhenTheMinimumIsOutside) {
  const GradientCost cost = [](const Eigen::VectorXd& x, CostSample& sample) {
    const Eigen::Vector2d target(1.5, 0.3);
    sample.value = 1.0 + (x - target).squaredNorm();
    sample.gradient = 2.0 * (x - target);
    sample.curvature = 2.0 * Eigen::Matrix2d::Identity();
  };
  int evaluations = 0;
  const DescentPoint point = run(cost, Eigen::Vector2d(0.1, 0.9), evaluations);
  EXPECT_TRUE(point.converged);
  EXPECT_EQ(point.x(0), 1.0);
  EXPECT_NEAR(point.x(1), 0.3, 1e-6);
  EXPECT_NEAR(projected_slope(point), 0.0, 1e-6);
}

TEST(BoxDescent, AFlatCostConvergesAtOnce) {
  const GradientCost cost = [](const Eigen::VectorXd& x, CostSample& sample) {
    sample.value = 3.0;
    sample.gradient = Eigen::VectorXd::Zero(x.size());
  };
  DescentPoint point = start_descent(cost, Eigen::Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(descend(cost, point, 1e-9), 0);
  EXPECT_TRUE(point.converged);
}

}  // namespace
}  // namespace strainwave
