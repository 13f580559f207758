// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway_pulse.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// Time in ms from `from_ns` until the pulse reports that a gateway hangs. It started at `started_ns`, and its turns do not change.
std::int64_t hangs_after_ms(GatewayPulse& pulse, std::int64_t started_ns, std::uint64_t turns,
                            std::int64_t from_ns) {
  for (std::int64_t ms = 0; ms < 20'000; ++ms)
    if (pulse.hangs(started_ns, turns, from_ns + ms * kMillisecond_ns)) return ms;
  return -1;
}

TEST(GatewayPulse, SeesWithinTwoSecondsThatAGatewayHangsHoweverYoungItIs) {
  for (const std::int64_t age_ms : {1, 100, 1000, 4999, 5000, 60'000}) {
    GatewayPulse pulse;
    EXPECT_FALSE(pulse.hangs(0, 0, 0));
    for (std::int64_t ms = 1; ms <= age_ms; ++ms)
      ASSERT_FALSE(pulse.hangs(0, static_cast<std::uint64_t>(ms), ms * kMillisecond_ns));
    EXPECT_EQ(hangs_after_ms(pulse, 0, static_cast<std::uint64_t>(age_ms), age_ms * kMillisecond_ns), 2000);
  }
}

TEST(GatewayPulse, GivesAGatewayTimeForItsFirstTurn) {
  GatewayPulse pulse;
  EXPECT_EQ(hangs_after_ms(pulse, 0, 0, 0), 5000);
}

TEST(GatewayPulse, TakesNoTurnOfAnEarlierGatewayForOneOfThis) {
  GatewayPulse pulse;
  EXPECT_FALSE(pulse.hangs(0, 76, kMillisecond_ns));
  EXPECT_FALSE(pulse.hangs(0, 77, 5001 * kMillisecond_ns)) << "its last, seen when it had gone";
  const std::int64_t again_ns = 6000 * kMillisecond_ns;
  EXPECT_EQ(hangs_after_ms(pulse, again_ns, 77, again_ns), 5000);
}

TEST(GatewayPulse, SaysAgainThatAGatewayGoesOnHanging) {
  GatewayPulse pulse;
  EXPECT_FALSE(pulse.hangs(0, 1, 0));
  EXPECT_FALSE(pulse.hangs(0, 2, kMillisecond_ns));
  EXPECT_EQ(hangs_after_ms(pulse, 0, 2, kMillisecond_ns), 2000);
  EXPECT_EQ(hangs_after_ms(pulse, 0, 2, 2001 * kMillisecond_ns), 2000);
}

}  // namespace
}  // namespace strainwave
