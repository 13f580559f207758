// SPDX-License-Identifier: BSD-3-Clause
// Counts below zero and counts too large to add up. No real loop sends them, but an attacker may.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <regex>

#include "telemetry/fleet.h"

namespace strainwave {
namespace {

constexpr double kNow_s = 1000.0;

TEST(DaemonMetrics, AreNotMadeOfMessagesThatCountBelowZero) {
  const auto shown = [](const auto& change) {
    Fleet fleet;
    timing_v1 timing{};
    change(timing);
    fleet.take({"SW", "", "TIMING"}, timing, kNow_s);
    return !fleet.daemons().empty();
  };
  EXPECT_TRUE(shown([](timing_v1&) {}));
  EXPECT_FALSE(shown([](timing_v1& t) { t.cycles = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.overruns = std::numeric_limits<std::int64_t>::min(); }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.page_faults = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.state_records_dropped = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.execution_time_max_ns = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.rejects[31] = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.wakeup_latency_count[63] = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.execution_time_count[0] = -1; }));
  EXPECT_FALSE(shown([](timing_v1& t) { t.position_delay_count[7] = -1; }));
}

TEST(DaemonMetrics, HaveHistogramsThatOnlyRiseWhateverIsCounted) {
  Fleet fleet;
  timing_v1 timing{};
  for (std::int64_t& count : timing.wakeup_latency_count) count = std::numeric_limits<std::int64_t>::max();
  fleet.take({"SW", "", "TIMING"}, timing, kNow_s);
  Exposition exposition;
  expose_daemons(exposition, fleet.daemons());
  const std::string page = std::move(exposition).text();
  const std::regex bucket(R"re(strainwave_wakeup_latency_seconds_bucket\{[^}]*\} (\S+))re");
  int buckets = 0;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), bucket); it != std::sregex_iterator();
       ++it, ++buckets)
    EXPECT_GE(std::stod((*it)[1]), 9.2e18);
  EXPECT_EQ(buckets, 17);
}

TEST(JointMetrics, AreNotMadeOfStatesThatCountBelowZero) {
  Fleet fleet;
  state_v1 state{};
  state.faults_total = -1;
  fleet.take({"SW", "elbow", "STATE"}, state, kNow_s);
  EXPECT_TRUE(fleet.joints().empty());
}

}  // namespace
}  // namespace strainwave
