// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/lmi.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

TEST(Lmi, ExpressionsAreAffineAndAgreeWithPlainMatrices) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  LmiProblem lmi;
  const AffineMatrix Q = lmi.symmetric(3);
  const AffineMatrix G = lmi.matrix(3, 3);
  const AffineMatrix M = lmi.matrix(1, 3);
  ASSERT_EQ(lmi.unknown_count(), 6 + 9 + 3);
  const Eigen::MatrixXd A = draw(3, 3);
  const Eigen::MatrixXd B = draw(3, 1);
  const Eigen::VectorXd x = draw(18, 1);
  const Eigen::MatrixXd q = Q.at(x), g = G.at(x), m = M.at(x);
  EXPECT_TRUE(q.isApprox(q.transpose(), 0.0));
  EXPECT_TRUE((2.0 * (A * G + B * M) - Q).at(x).isApprox(2.0 * (A * g + B * m) - q, 1e-14));
  const Eigen::MatrixXd whole =
      symmetric_blocks({{G + G.transpose() - Q}, {A * G + B * M, Q}, {M, {}, Eigen::MatrixXd(draw(1, 1))}})
          .at(x);
  ASSERT_EQ(whole.rows(), 7);
  EXPECT_TRUE(whole.isApprox(whole.transpose(), 0.0));
  EXPECT_TRUE(whole.block(3, 0, 3, 3).isApprox(A * g + B * m, 1e-14));
  EXPECT_TRUE(whole.block(6, 3, 1, 3).isZero(0.0));
  EXPECT_TRUE(whole.block(6, 0, 1, 3).isApprox(m, 0.0));
}

TEST(Lmi, ViolationIsTheMostNegativeEigenvalue) {
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar();
  lmi.require_positive(x + Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, -2.0)));
  EXPECT_DOUBLE_EQ(lmi.violation(Eigen::VectorXd::Constant(1, 1.5)), 0.5);
  EXPECT_LT(lmi.violation(Eigen::VectorXd::Constant(1, 2.5)), 0.0);
}

}  // namespace
}  // namespace strainwave
