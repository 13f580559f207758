// SPDX-License-Identifier: BSD-3-Clause
#include "base/token_bucket.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(TokenBucket, GivesTheBurstAtOnceAndThenTheRate) {
  TokenBucket bucket(10.0, 5.0);
  std::int64_t now_ns = nanoseconds(1000.0);
  int at_once = 0;
  while (bucket.try_take(now_ns)) ++at_once;
  EXPECT_EQ(at_once, 5);
  int in_ten_seconds = 0;
  for (int millisecond = 0; millisecond < 10000; ++millisecond) {
    now_ns += nanoseconds(1e-3);
    if (bucket.try_take(now_ns)) ++in_ten_seconds;
  }
  EXPECT_NEAR(in_ten_seconds, 100, 1);
}

TEST(TokenBucket, NeverHoldsMoreThanTheBurst) {
  TokenBucket bucket(10.0, 5.0);
  EXPECT_EQ(bucket.left(nanoseconds(1e6)), 5.0);
}

TEST(TokenBucket, TakesTimeThatGoesBackForTimeThatStandsStill) {
  TokenBucket bucket(10.0, 1.0);
  ASSERT_TRUE(bucket.try_take(nanoseconds(10.0)));
  EXPECT_FALSE(bucket.try_take(nanoseconds(5.0)));
  EXPECT_FALSE(bucket.try_take(nanoseconds(10.05)));
  EXPECT_TRUE(bucket.try_take(nanoseconds(10.11)));
}

}  // namespace
}  // namespace strainwave
