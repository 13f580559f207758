// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/bounded_matrix.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

ProofMatrix random_matrix(std::mt19937_64& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> power(-12, 12);
  return ProofMatrix::NullaryExpr(rows, columns, [&] { return std::ldexp(normal(random), power(random)); });
}

// A bounded matrix, and an exact matrix within its bounds.
struct Meant {
  BoundedMatrix bounded;
  Wide exact;
};

Meant random_meant(std::mt19937_64& random, Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<double> share(-0.99, 0.99);
  const ProofMatrix value = random_matrix(random, rows, columns);
  const ProofMatrix error =
      1e-14 * random_matrix(random, rows, columns).cwiseAbs() + 1e-16 * value.cwiseAbs();
  Wide exact = value.cast<long double>();
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) exact(i, j) += share(random) * error(i, j);
  return {BoundedMatrix::from(value, error), exact};
}

bool covers(const BoundedMatrix& bounded, const Wide& exact) {
  return ((bounded.value.cast<long double>() - exact).cwiseAbs().array() <=
          bounded.error.cast<long double>().array())
      .all();
}

TEST(BoundedMatrix, SumsDifferencesAndProductsCoverWhatTheirFactorsMayBe) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Meant a = random_meant(random, 5, 8);
    const Meant b = random_meant(random, 8, 3);
    const Meant c = random_meant(random, 5, 8);
    ASSERT_TRUE(covers(a.bounded * b.bounded, a.exact.lazyProduct(b.exact)));
    ASSERT_TRUE(covers(a.bounded + c.bounded, a.exact + c.exact));
    ASSERT_TRUE(covers(a.bounded - c.bounded, a.exact - c.exact));
    ASSERT_TRUE(covers(Bounded(0.1) * a.bounded, 0.1 * a.exact));
    ASSERT_TRUE(covers(a.bounded.transpose(), a.exact.transpose()));
  }
}

TEST(BoundedMatrix, AProductOfExactFactorsIsBoundedToSomeRoundings) {
  std::mt19937_64 random(4);
  const ProofMatrix a = random_matrix(random, 8, 8);
  const BoundedMatrix product = BoundedMatrix(a) * BoundedMatrix(a);
  const ProofMatrix size = a.cwiseAbs().lazyProduct(a.cwiseAbs());
  EXPECT_TRUE((product.error.array() <= 10.0 * bounded_detail::kHalfUlp * size.array() + 1e-300).all());
}

}  // namespace
}  // namespace strainwave
