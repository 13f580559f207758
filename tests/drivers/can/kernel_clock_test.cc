// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/kernel_clock.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::int64_t kEpoch_ns = 1'795'000'000'000'000'000;  // the kernel's time when the loop's time is 0

TEST(KernelClock, SaysNothingBeforeItHasHeardAnEcho) {
  KernelClock clock(kPeriod_ns);
  EXPECT_FALSE(clock.loop_time_ns(kEpoch_ns));
  clock.sent(kPeriod_ns);
  EXPECT_FALSE(clock.loop_time_ns(kEpoch_ns));
  clock.echoed(0);
  EXPECT_FALSE(clock.loop_time_ns(kEpoch_ns));
}

TEST(KernelClock, TellsWhenAFrameCameHoweverTheEchoesJitter) {
  KernelClock clock(kPeriod_ns);
  for (std::int64_t cycle = 1; cycle <= 200; ++cycle) {
    clock.sent(cycle * kPeriod_ns);
    const std::int64_t jitter_ns = (cycle * 7919 % 101 - 50) * 1000;
    clock.echoed(kEpoch_ns + cycle * kPeriod_ns + 200'000 + jitter_ns);
  }
  const auto time_ns = clock.loop_time_ns(kEpoch_ns + 300 * kPeriod_ns + 200'000);
  ASSERT_TRUE(time_ns);
  EXPECT_NEAR(static_cast<double>(*time_ns - 300 * kPeriod_ns), 0.0, 25'000.0);
}

TEST(KernelClock, IsNotMisledByEchoesThatComeACycleLate) {
  KernelClock clock(kPeriod_ns);
  for (std::int64_t cycle = 1; cycle <= 100; ++cycle) {
    clock.sent(cycle * kPeriod_ns);
    const std::int64_t late_cycles = cycle % 5 == 0 ? 1 : 0;
    clock.echoed(kEpoch_ns + (cycle - late_cycles) * kPeriod_ns);
  }
  EXPECT_EQ(*clock.loop_time_ns(kEpoch_ns), 0);
}

TEST(KernelClock, FollowsAClockThatSomebodyHasSet) {
  KernelClock clock(kPeriod_ns);
  for (std::int64_t cycle = 1; cycle <= 100; ++cycle) {
    clock.sent(cycle * kPeriod_ns);
    clock.echoed((cycle <= 50 ? kEpoch_ns : kEpoch_ns - 3'600'000'000'000) + cycle * kPeriod_ns);
  }
  EXPECT_EQ(*clock.loop_time_ns(kEpoch_ns - 3'600'000'000'000), 0);
}

}  // namespace
}  // namespace strainwave
