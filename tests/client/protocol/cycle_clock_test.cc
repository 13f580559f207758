// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/cycle_clock.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;

Instant at(double seconds) {
  return Instant{} + std::chrono::duration_cast<Instant::duration>(std::chrono::duration<double>(seconds));
}

TEST(CycleClock, IsNoFartherBehindThanTheFastestOfTheStates) {
  CycleClock clock;
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> delay_s(0.001, 0.03);
  double fastest_s = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double travelled_s = delay_s(chance);
    fastest_s = std::min(fastest_s, travelled_s);
    clock.take(5 * i, at(1.0 + 5 * i * kPeriod_s + travelled_s));
  }
  const double cycle = clock.cycle_at(at(2.0), kPeriod_s);
  EXPECT_NEAR(cycle, 1000.0 - fastest_s / kPeriod_s, 1e-3);
}

TEST(CycleClock, ForgetsStatesThatAreLongAgoSoThatADriftingClockIsFollowed) {
  CycleClock clock;
  // The daemon's periods are 2 % longer than they should be.
  for (int i = 0; i < 1000; ++i) clock.take(i, at(1.02 * kPeriod_s * i));
  EXPECT_NEAR(clock.cycle_at(at(1.02 * kPeriod_s * 999), kPeriod_s), 999.0, 0.02 * CycleClock::kStates);
}

TEST(CycleClock, StartsAnewWithARestartedDaemon) {
  CycleClock clock;
  clock.take(100000, at(1.0));
  clock.restart();
  EXPECT_TRUE(clock.empty());
  clock.take(10, at(2.0));
  EXPECT_NEAR(clock.cycle_at(at(2.001), kPeriod_s), 11.0, 1e-6);
}

}  // namespace
}  // namespace strainwave
