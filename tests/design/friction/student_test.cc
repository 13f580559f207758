// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/student.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

// Values from two-sided tables of the distribution.
TEST(Student, GivesTheTabulatedQuantiles) {
  EXPECT_NEAR(student_t(0.95, 1), 12.7062, 1e-3);
  EXPECT_NEAR(student_t(0.95, 2), 4.30265, 1e-4);
  EXPECT_NEAR(student_t(0.95, 7), 2.36462, 1e-4);
  EXPECT_NEAR(student_t(0.99, 10), 3.16927, 1e-4);
  EXPECT_NEAR(student_t(0.5, 3), 0.764892, 1e-5);
  EXPECT_NEAR(student_t(0.95, 100000), 1.95999, 1e-4);
}

TEST(Student, GrowsWithTheConfidenceAndFallsWithTheDegreesOfFreedom) {
  for (int n = 1; n < 40; ++n) {
    EXPECT_GT(student_t(0.95, n), student_t(0.95, n + 1)) << n;
    EXPECT_GT(student_t(0.99, n), student_t(0.95, n)) << n;
  }
}

}  // namespace
}  // namespace strainwave
