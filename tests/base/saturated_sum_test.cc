// SPDX-License-Identifier: BSD-3-Clause
#include "base/saturated_sum.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

TEST(SaturatedSum, IsTheSumAsFarAsNumbersGo) {
  EXPECT_EQ(saturated_sum(2, 3), 5);
  EXPECT_EQ(saturated_sum(2, -3), -1);
  EXPECT_EQ(saturated_sum(kMost, kLeast), -1);
  EXPECT_EQ(saturated_sum(kMost - 1, 1), kMost);
  EXPECT_EQ(saturated_sum(kMost, 1), kMost);
  EXPECT_EQ(saturated_sum(kMost, kMost), kMost);
  EXPECT_EQ(saturated_sum(kLeast, -1), kLeast);
  EXPECT_EQ(saturated_sum(kLeast, kLeast), kLeast);
}

}  // namespace
}  // namespace strainwave
