// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/riccati.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/eigenvalues.h"

namespace strainwave {
namespace {

TEST(Riccati, ItsSolutionSatisfiesTheEquationAndStabilises) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Index n = 2 + trial % 6;
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return 0.7 * normal(random); });
    const Eigen::VectorXd B = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
    const Eigen::VectorXd W = Eigen::VectorXd::NullaryExpr(n, [&] { return std::exp(2.0 * normal(random)); });
    const double R = std::exp(normal(random));
    const auto P = solve_riccati(A, B, W, R);
    ASSERT_TRUE(P.has_value()) << trial;
    const Eigen::RowVectorXd F = -B.transpose() * *P * A / (R + B.dot(*P * B));
    const Eigen::MatrixXd again = A.transpose() * *P * (A + B * F) + Eigen::MatrixXd(W.asDiagonal());
    EXPECT_LT((again - *P).norm(), 1e-7 * P->norm()) << trial;
    EXPECT_LT(testing::spectral_radius(A + B * F), 1.0) << trial;
  }
}

TEST(Riccati, ASlowAndHeavyPlantIsSolvedAsWell) {
  const double period_s = 1e-3, inertia_kgm2 = 1000.0;
  Eigen::Matrix3d A;
  A << 1.0, period_s, 0.0, 0.0, 1.0, period_s, 0.0, 0.0, 1.0;
  const Eigen::Vector3d B(0.0, 0.5 * period_s * period_s / inertia_kgm2, period_s / inertia_kgm2);
  const auto P = solve_riccati(A, B, Eigen::Vector3d(0.1, 1.0, 1e-4), 1e-6);
  ASSERT_TRUE(P.has_value());
  EXPECT_GT((*P)(1, 1), 1e3);
  EXPECT_LT((*P)(1, 1), 1e5);
}

TEST(Riccati, HasNoAnswerForAPlantThatCannotBeStabilised) {
  EXPECT_FALSE(solve_riccati(Eigen::Vector2d(1.2, 0.5).asDiagonal(), Eigen::Vector2d(0.0, 1.0),
                             Eigen::Vector2d::Ones(), 1.0)
                   .has_value());
}

}  // namespace
}  // namespace strainwave
