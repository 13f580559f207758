// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

TEST(NonnegativeLeastSquares, SatisfiesTheOptimalityConditionsOfRandomProblems) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Index n = 1 + trial % 15;
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n + 5, n, [&] { return normal(random); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n + 5, [&] { return normal(random); });
    const SmallMatrix H = A.transpose() * A;
    const SmallVector g = A.transpose() * b;
    const NonnegativeSolution solution = solve_nonnegative(H, g);
    const Eigen::VectorXd slope = H * solution.x - g;
    ASSERT_GE(solution.x.minCoeff(), 0.0);
    ASSERT_GE(slope.minCoeff(), -1e-9) << "an unknown at zero wants to grow";
    ASSERT_NEAR(slope.dot(solution.x), 0.0, 1e-8) << "a free unknown is not at its minimum";
    held += static_cast<int>(n - solution.free.count);
  }
  EXPECT_GT(held, 1000);
}

TEST(NonnegativeLeastSquares, GivesTheUnconstrainedMinimumWhereThatIsPositive) {
  const SmallMatrix H = 2.0 * SmallMatrix::Identity(3, 3);
  const NonnegativeSolution solution = solve_nonnegative(H, SmallVector(Eigen::Vector3d(2.0, 4.0, 6.0)));
  EXPECT_TRUE(Eigen::Vector3d(solution.x).isApprox(Eigen::Vector3d(1.0, 2.0, 3.0), 1e-14));
  EXPECT_EQ(solution.free.count, 3);
}

TEST(NonnegativeLeastSquares, EverythingAtZeroIsASolutionToo) {
  const NonnegativeSolution solution =
      solve_nonnegative(SmallMatrix::Identity(2, 2), SmallVector(Eigen::Vector2d(-1.0, -2.0)));
  EXPECT_TRUE(Eigen::Vector2d(solution.x).isZero(0.0));
  EXPECT_EQ(solution.free.count, 0);
}

}  // namespace
}  // namespace strainwave
