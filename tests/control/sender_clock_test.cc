// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/sender_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr std::int64_t kEpoch_us = 1'700'000'000'000'000;

/// Takes message `i`, sent in period 20 i, after a transport delay of `way` periods. Returns its arrival with the usual delay.
double taken(SenderClock& clock, int i, double way, std::int64_t set_us = 0) {
  clock.take(kEpoch_us + set_us + 20'000 * i, 20.0 * i + way);
  return clock.sent() + clock.offset();
}

TEST(SenderClock, TakesAWayThatStaysLongerForTheWay) {
  SenderClock clock(kPeriod_s);
  for (int i = 0; i < 50; ++i) taken(clock, i, 3.0);
  double offset = 0.0;
  for (int i = 50; i < 60; ++i) offset = taken(clock, i, 33.0) - 20.0 * i;
  EXPECT_NEAR(offset, 33.0, 1.0);
  for (int i = 60; i < 62; ++i) offset = taken(clock, i, 3.0) - 20.0 * i;
  EXPECT_NEAR(offset, 3.0, 1.0) << "and one that gets shorter at once";
}

TEST(SenderClock, TakesWhatComesByAClockThatWasSetForWhenItCame) {
  SenderClock clock(kPeriod_s);
  for (int i = 0; i < 50; ++i) taken(clock, i, 3.0);
  int i = 50;
  for (const std::int64_t set_us :
       {std::int64_t{3'600'000'000}, std::int64_t{-7'200'000'000}, std::int64_t{300'000}}) {
    EXPECT_NEAR(taken(clock, i, 4.0, set_us), 20.0 * i + 4.0, 1e-6) << "the first as it came";
    ++i;
    EXPECT_NEAR(taken(clock, i, 3.0, set_us), 20.0 * i + 4.0, 1.0) << "and the next by the clock";
    ++i;
  }
}

TEST(SenderClock, TakesWhatComesByAClockThatStandsForWhenItCame) {
  SenderClock clock(kPeriod_s);
  for (int i = 0; i < 100; ++i) {
    clock.take(kEpoch_us, 20.0 * i + 3.0);
    EXPECT_NEAR(clock.sent() + clock.offset(), 20.0 * i + 3.0, 1e-6) << i;
  }
}

TEST(SenderClock, FollowsAClockOfAnotherRate) {
  SenderClock clock(kPeriod_s);
  double offset = 0.0;
  for (int i = 0; i < 5000; ++i) {
    clock.take(kEpoch_us + 20'004 * i, 20.0 * i + 3.0);
    offset = clock.sent() + clock.offset() - 20.0 * i;
  }
  EXPECT_NEAR(offset, 3.0, 0.25);
}

TEST(SenderClock, TakesAnyNumber) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  SenderClock clock(kPeriod_s);
  for (const std::int64_t sent_us : {kLast, std::int64_t{1}, kLast, kLast, kLast - 1, std::int64_t{1}}) {
    clock.take(sent_us, 5.0);
    EXPECT_TRUE(std::isfinite(clock.sent() + clock.offset()));
  }
}

}  // namespace
}  // namespace strainwave
