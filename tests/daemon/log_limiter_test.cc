#include <gtest/gtest.h>

#include "daemon/admission/token_bucket.h"
#include "daemon/log.h"

namespace strainwave {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(LogLimiter, LetsTheBurstThroughInEveryWindowAndAccountsForTheRest) {
  LogLimiter limiter(20, 10 * kSecond_ns);
  std::int64_t logged = 0;
  std::int64_t reported = 0;
  constexpr int kLines = 100'000;
  for (int i = 0; i < kLines; ++i) {
    std::int64_t suppressed = 0;
    // 1000 lines a second for 100 s: 10 windows.
    if (limiter.allow(11 * kSecond_ns + i * (kSecond_ns / 1000), suppressed)) ++logged;
    reported += suppressed;
  }
  EXPECT_EQ(logged, 10 * 20);
  EXPECT_EQ(reported, 9 * (10'000 - 20));
}

TEST(TokenBucket, GivesTheBurstAtOnceAndThenItsRate) {
  TokenBucket bucket(100.0, 10.0);
  int taken = 0;
  while (bucket.try_take(0)) ++taken;
  EXPECT_EQ(taken, 10);
  for (int i = 1; i <= 10'000; ++i) taken += bucket.try_take(i * (kSecond_ns / 1000)) ? 1 : 0;
  EXPECT_NEAR(taken, 10 + 1000, 1);
}

TEST(TokenBucket, NeverHoldsMoreThanTheBurst) {
  TokenBucket bucket(100.0, 10.0);
  int taken = 0;
  while (bucket.try_take(1000 * kSecond_ns)) ++taken;
  EXPECT_EQ(taken, 10);
}

}  // namespace
}  // namespace strainwave
