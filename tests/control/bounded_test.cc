// SPDX-License-Identifier: BSD-3-Clause
#include "control/bounded.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

// A long double has 11 more bits than a double. Its own error is far below the tested bounds.
struct Pair {
  Bounded bounded;
  long double exact = 0.0L;
};

Pair random_expression(std::mt19937_64& random, int depth) {
  if (depth == 0) {
    const double value = std::uniform_real_distribution<double>(-3.0, 3.0)(random);
    return {Bounded(value), value};
  }
  const Pair a = random_expression(random, depth - 1);
  const Pair b = random_expression(random, depth - 1);
  switch (std::uniform_int_distribution<int>(0, 3)(random)) {
    case 0:
      return {a.bounded + b.bounded, a.exact + b.exact};
    case 1:
      return {a.bounded - b.bounded, a.exact - b.exact};
    case 2:
      return {a.bounded * b.bounded, a.exact * b.exact};
    default:
      return {a.bounded / b.bounded, a.exact / b.exact};
  }
}

TEST(Bounded, ErrorBoundsCoverWhatHappensInRandomExpressions) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Pair result = random_expression(random, 5);
    if (!std::isfinite(result.bounded.error)) continue;
    const long double error = std::abs(static_cast<long double>(result.bounded.value) - result.exact);
    // The factor covers the long double's own error, 2^-64 relative per operation. The bound is 2^-53 per operation.
    ASSERT_LE(error, static_cast<long double>(result.bounded.error) * 1.001L) << i;
  }
}

TEST(Bounded, BoundsAreNotWildlyPessimistic) {
  Bounded sum = 0.0;
  for (int i = 0; i < 100; ++i) sum = sum + Bounded(0.1) * 0.3;
  EXPECT_LT(sum.error, 200 * 3.0 * 0x1p-53);
}

TEST(Bounded, ExactNumbersHaveNoErrorAndZeroTimesAnythingIsZero) {
  EXPECT_EQ(Bounded(0.3).error, 0.0);
  EXPECT_EQ((Bounded(0.0) * Bounded(1.0, 0.5)).error, 0.0);
}

TEST(Bounded, DivisionByWhatMayBeZeroHasNoFiniteBound) {
  EXPECT_TRUE(std::isinf((Bounded(1.0) / Bounded(1e-9, 1e-8)).error));
}

}  // namespace
}  // namespace strainwave
