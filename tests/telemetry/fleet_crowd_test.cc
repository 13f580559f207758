// SPDX-License-Identifier: BSD-3-Clause
// The names that are shown when more names are heard than there are places.
#include <gtest/gtest.h>

#include "telemetry/fleet.h"

namespace strainwave {
namespace {

constexpr double kNow_s = 1000.0;

TEST(Fleet, ShowsARealDaemonWhoeverHasMadeUpNamesBeforeAndGoesOnDoingSo) {
  const LcmSource daemon{0x0A000002, 40000};
  for (const LcmSource& flooder : {LcmSource{0x0A000003, 40000}, LcmSource{0x0A000002, 50000}}) {
    Fleet fleet;
    const auto flood = [&](const std::string& first, int names, double now_s) {
      for (int i = 0; i < names; ++i) {
        fleet.take({"SW", first + std::to_string(i), "STATE"}, state_v1{}, now_s, flooder);
        fleet.take({first + std::to_string(i), "", "TIMING"}, timing_v1{}, now_s, flooder);
      }
    };
    flood("a", 5000, kNow_s);
    for (int k = 0; k < 64; ++k)
      fleet.take({"SW", "joint" + std::to_string(k), "STATE"}, state_v1{}, kNow_s + 0.001, daemon);
    fleet.take({"SW", "joint0", "LIMITS"}, limits_v1{}, kNow_s + 0.001, daemon);
    fleet.take({"SW", "", "TIMING"}, timing_v1{}, kNow_s + 0.001, daemon);
    flood("b", 5000, kNow_s + 0.9);
    for (int k = 0; k < 64; ++k)
      EXPECT_TRUE(fleet.joints().contains({"SW", "joint" + std::to_string(k)})) << k;
    EXPECT_TRUE(fleet.joints().at({"SW", "joint0"}).limits.has_value());
    EXPECT_TRUE(fleet.daemons().contains("SW"));
    EXPECT_EQ(fleet.joints().size(), Fleet::kMaxJoints);
  }
}

TEST(Fleet, HearsANewJointThoughEveryPlaceIsTakenFromAPortOfItsOwn) {
  Fleet fleet;
  for (std::uint16_t port = 0; port < 2000; ++port)
    fleet.take({"SW", "a" + std::to_string(port), "STATE"}, state_v1{}, kNow_s, {0x7F000001, port});
  fleet.take({"SW", "elbow", "STATE"}, state_v1{}, kNow_s + 0.1, {0x7F000001, 40000});
  EXPECT_TRUE(fleet.joints().contains({"SW", "elbow"}));
}

}  // namespace
}  // namespace strainwave
