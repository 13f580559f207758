// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/debounce.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::uint32_t kHome = bit(LineRole::kHome);
constexpr std::uint32_t kStop = bit(LineRole::kEmergencyStop);

Debounce of_home(std::int64_t steady_ns) {
  std::array<std::int64_t, kLineRoles> times{};
  times[static_cast<std::size_t>(LineRole::kHome)] = steady_ns;
  return Debounce(times);
}

TEST(Debounce, BelievesALevelOnceItHasBeenSteadyForItsTime) {
  Debounce debounce = of_home(5 * kPeriod_ns);
  std::int64_t now_ns = 0;
  EXPECT_EQ(debounce.step(0, now_ns), 0U);
  int periods = 0;
  while (debounce.step(kHome, now_ns += kPeriod_ns) == 0) ++periods;
  EXPECT_EQ(periods, 5) << "from the first reading on, since nobody knows when before it the level came";
  for (int i = 0; i < 5; ++i) EXPECT_EQ(debounce.step(0, now_ns += kPeriod_ns), kHome) << "both ways";
  EXPECT_EQ(debounce.step(0, now_ns += kPeriod_ns), 0U);
}

TEST(Debounce, NeverBelievesAContactThatBouncesFasterThanItsTime) {
  Debounce debounce = of_home(5 * kPeriod_ns);
  std::mt19937 random(7);
  std::int64_t now_ns = 0;
  (void)debounce.step(0, now_ns);
  for (int i = 0; i < 10'000; ++i) {
    // The contact is on for at most four periods in a row.
    const bool on = i % 5 != 0 && random() % 2 == 0;
    ASSERT_EQ(debounce.step(on ? kHome : 0, now_ns += kPeriod_ns), 0U) << i;
  }
}

TEST(Debounce, WaitsForASecondReadingHoweverShortItsTime) {
  Debounce debounce = of_home(1);
  (void)debounce.step(0, 0);
  EXPECT_EQ(debounce.step(kHome, kPeriod_ns), 0U);
  EXPECT_EQ(debounce.step(kHome, 2 * kPeriod_ns), kHome);
}

TEST(Debounce, BelievesAtOnceWhatHasNoTimeAndWhatItBeginsWith) {
  Debounce debounce = of_home(5 * kPeriod_ns);
  EXPECT_EQ(debounce.step(kHome, 100), kHome);
  EXPECT_EQ(debounce.step(kHome | kStop, 100 + kPeriod_ns), kHome | kStop);
  EXPECT_EQ(debounce.step(kHome, 100 + 2 * kPeriod_ns), kHome);
}

}  // namespace
}  // namespace strainwave
