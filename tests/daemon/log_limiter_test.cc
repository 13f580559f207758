// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace strainwave
