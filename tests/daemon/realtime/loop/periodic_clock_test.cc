// SPDX-License-Identifier: BSD-3-Clause
// The clock's promises, which hold whatever the host does. No duration is asserted.
#include "daemon/realtime/loop/periodic_clock.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

TEST(PeriodicClock, WakesNoneTooSoonForTheNearestInstantAndSaysHowManyItLeftOut) {
  PeriodicClock clock(kPeriod_ns);
  clock.start();
  std::int64_t previous_ns = clock.wait().instant_ns;
  for (int i = 0; i < 50; ++i) {
    if (i % 10 == 0) busy_wait(5 * kPeriod_ns / 2);
    const PeriodicClock::Wake wake = clock.wait();
    EXPECT_GE(wake.woke_ns, wake.due_ns);
    EXPECT_LE(std::abs(wake.woke_ns - wake.instant_ns), kPeriod_ns / 2) << "also when the host overslept";
    EXPECT_EQ(wake.instant_ns - previous_ns, (1 + wake.skipped) * kPeriod_ns);
    previous_ns = wake.instant_ns;
  }
}

TEST(PeriodicClock, LeavesOutTheCyclesThatAreOverAndSqueezesNoneIn) {
  PeriodicClock clock(kPeriod_ns);
  clock.start();
  (void)clock.wait();
  busy_wait(7 * kPeriod_ns / 2);
  const std::int64_t before_ns = monotonic_now_ns();
  const PeriodicClock::Wake wake = clock.wait();
  EXPECT_GE(wake.skipped, 3);
  EXPECT_GE(wake.due_ns, before_ns) << "the next instant that lies ahead";
}

}  // namespace
}  // namespace strainwave
