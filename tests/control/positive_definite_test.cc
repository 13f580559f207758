// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/positive_definite.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <limits>
#include <random>

#include "control/table/gain_table.h"

namespace strainwave {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();

StateMatrix random_orthogonal(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  StateMatrix matrix = StateMatrix::NullaryExpr([&] { return normal(random); });
  return Eigen::HouseholderQR<StateMatrix>(matrix).householderQ();
}

bool certain(const StateMatrix& matrix, int size = 3) {
  return test_positive_definite(matrix, StateMatrix::Zero(), size).certain;
}

// Positive definiteness from the leading minors in long double: an independent reference near the rounding limit.
bool positive_in_long_double(const StateMatrix& matrix) {
  using Wide = Eigen::Matrix<long double, 3, 3>;
  const Wide m = matrix.cast<long double>();
  const long double second = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  const long double third = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
                            m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
                            m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
  return m(0, 0) > 0.0L && second > 0.0L && third > 0.0L;
}

TEST(PositiveDefinite, AcceptsClearCasesAndRefusesIndefiniteOnes) {
  EXPECT_TRUE(certain(StateMatrix::Identity()));
  EXPECT_FALSE(certain(-StateMatrix::Identity()));
  EXPECT_FALSE(certain(StateMatrix::Zero()));
  EXPECT_FALSE(certain(StateMatrix::Ones()));  // semidefinite is not definite
  StateMatrix indefinite = StateMatrix::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 1.5;
  EXPECT_FALSE(certain(indefinite));
}

TEST(PositiveDefinite, NeverAcceptsWhatLongDoubleRefusesNearTheRoundingLimit) {
  std::mt19937_64 random(2);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    const StateMatrix V = random_orthogonal(random);
    const double smallest = std::uniform_real_distribution<double>(-40.0, 200.0)(random) * kUlp;
    StateMatrix matrix = V * StateVector(smallest, 1.0, 2.0).asDiagonal() * V.transpose();
    matrix = (0.5 * (matrix + matrix.transpose())).eval();
    if (certain(matrix)) {
      ++accepted;
      ASSERT_TRUE(positive_in_long_double(matrix)) << matrix;
    }
  }
  EXPECT_GT(accepted, 1000);  // the test does not refuse everything
}

TEST(PositiveDefinite, AcceptsFromAFewHundredUlpsOn) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5000; ++i) {
    const StateMatrix V = random_orthogonal(random);
    StateMatrix matrix = V * StateVector(400.0 * kUlp, 1.0, 2.0).asDiagonal() * V.transpose();
    matrix = (0.5 * (matrix + matrix.transpose())).eval();
    ASSERT_TRUE(certain(matrix)) << matrix;
  }
}

TEST(PositiveDefinite, ScalesOfTheStatesDoNotMatter) {
  StateMatrix matrix;
  matrix << 2.0, -0.9, 0.3, -0.9, 1.0, 0.2, 0.3, 0.2, 0.8;
  ASSERT_TRUE(certain(matrix));
  const StateVector scale(0x1p-60, 1.0, 0x1p55);
  const StateMatrix scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const auto plain = test_positive_definite(matrix, StateMatrix::Zero(), 3);
  const auto result = test_positive_definite(scaled, StateMatrix::Zero(), 3);
  EXPECT_TRUE(result.certain);
  EXPECT_EQ(result.margin, plain.margin);  // powers of two are exact
}

TEST(PositiveDefinite, AnErrorThatCouldReachTheBorderIsRefused) {
  const StateMatrix matrix = StateMatrix::Identity();
  EXPECT_TRUE(test_positive_definite(matrix, StateMatrix::Constant(0.3), 3).certain);
  EXPECT_FALSE(test_positive_definite(matrix, StateMatrix::Constant(0.34), 3).certain);
}

TEST(PositiveDefinite, OnlyTheLeadingBlockCounts) {
  StateMatrix matrix = StateMatrix::Identity();
  matrix(2, 2) = -1.0;
  EXPECT_TRUE(certain(matrix, 2));
  EXPECT_FALSE(certain(matrix, 3));
  EXPECT_TRUE(certain(matrix, 1));
}

TEST(PositiveDefinite, NotANumberAndInfinityAreRefusedAnywhere) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (Eigen::Index i = 0; i < 9; ++i) {
      StateMatrix matrix = StateMatrix::Identity();
      matrix(i) = bad;
      EXPECT_FALSE(certain(matrix));
      StateMatrix error = StateMatrix::Zero();
      error(i) = bad;
      EXPECT_FALSE(test_positive_definite(StateMatrix::Identity(), error, 3).certain);
    }
  }
}

TEST(PositiveDefinite, TheMarginIsPositiveExactlyWhenCertain) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 5000; ++i) {
    const StateMatrix V = random_orthogonal(random);
    const double smallest = std::uniform_real_distribution<double>(-1e-14, 1e-14)(random);
    const StateMatrix matrix = V * StateVector(smallest, 0.1, 3.0).asDiagonal() * V.transpose();
    const auto result = test_positive_definite(matrix, StateMatrix::Zero(), 3);
    ASSERT_EQ(result.certain, result.margin > 0.0);
  }
}

}  // namespace
}  // namespace strainwave
