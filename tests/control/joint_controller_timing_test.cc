// The controller when positions are late and periods are left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "control/units.h"
#include "tests/control/controlled_joint.h"

namespace strainwave::testing {
namespace {

struct LateMove {
  double rest_rad = 0.0;
  double overshoot_rad = 0.0;
  MonitorState monitor = MonitorState::kWatching;
};
LateMove move_late(int late_periods, bool told) {
  ControlledJoint loop;
  loop.tells_lateness = told;
  loop.controller().set_target(0.1);
  loop.run(1.0);
  loop.late_periods = late_periods;
  loop.run(0.1);
  loop.controller().set_target(0.4);
  LateMove result;
  for (int k = 0; k < 2000; ++k) {
    result.monitor = loop.step().monitor;
    const double beyond_rad = loop.position_rad() - 0.4;
    result.overshoot_rad = std::max(result.overshoot_rad, beyond_rad);
    if (k >= 1500) result.rest_rad = std::max(result.rest_rad, std::abs(beyond_rad));
  }
  return result;
}

TEST(JointControllerTiming, ALatePositionDoesLessHarmWhenItsLatenessIsKnown) {
  for (const int periods : {1, 2, 3}) {
    const LateMove told = move_late(periods, true);
    const LateMove untold = move_late(periods, false);
    EXPECT_LT(told.rest_rad, 1e-4) << periods;
    EXPECT_LT(told.overshoot_rad, 5e-4) << periods;
    EXPECT_EQ(told.monitor, MonitorState::kWatching) << periods;
    EXPECT_TRUE(untold.overshoot_rad > 5e-3 || untold.monitor != MonitorState::kWatching)
        << periods << ": it is the knowledge that helps";
  }
}

TEST(JointControllerTiming, TakesSkippedPeriodsForWhatTheyAre) {
  for (const int skipped : {1, 2, 5, 19}) {
    ControlledJoint loop;
    loop.controller().set_target(10.0, 2.0);
    loop.run(1.0);
    const JointStep before = loop.step();
    ASSERT_NEAR(before.estimate.velocity_rad_s, 2.0, 0.01);
    loop.skip(skipped);
    for (int k = 0; k < 50; ++k) {
      const double true_rad_s = loop.velocity_rad_s();
      const JointStep after = loop.step();
      EXPECT_NEAR(after.estimate.velocity_rad_s, true_rad_s, skipped > 5 ? 0.1 : 0.02) << skipped;
      EXPECT_NEAR(after.output.torque_Nm, before.output.torque_Nm, skipped > 5 ? 5.0 : 1.0) << skipped;
      EXPECT_NEAR(after.reference.position_rad - before.reference.position_rad,
                  2.0 * 0.001 * (skipped + 1 + k), 1e-9);
      EXPECT_EQ(after.replans, 0);
    }
  }
}

TEST(JointControllerTiming, ArrivesToTheCountAlthoughPeriodsWereSkippedOnTheWay) {
  for (const int begin : {5, 40, 60, 80}) {
    ControlledJoint loop;
    loop.controller().set_target(1.0);
    for (int k = 0; k < begin; ++k) loop.step();
    loop.skip(2);
    double furthest_rad = 0.0;
    for (int k = 0; k < 1500; ++k) {
      loop.step();
      furthest_rad = std::max(furthest_rad, loop.position_rad());
    }
    EXPECT_LE(std::abs(loop.position_rad() - 1.0), kCount_rad) << begin;
    EXPECT_LE(furthest_rad, 1.01) << begin;
  }
}

TEST(JointControllerTiming, GoesOnFromWhereTheJointIsAfterAStallThatNoModelKnows) {
  for (const int skipped : {20, 80, 2000}) {
    ControlledJoint loop;
    loop.controller().set_target(10.0, 2.0);
    loop.run(1.0);
    const JointStep before = loop.step();
    const double from_rad = loop.position_rad();
    loop.skip(skipped);
    const double mean_rad_s = (loop.position_rad() - from_rad) / (0.001 * skipped);
    const JointStep after = loop.step();
    EXPECT_NEAR(after.estimate.velocity_rad_s, mean_rad_s, 0.1)
        << "over all periods that passed: " << skipped;
    EXPECT_NEAR(after.reference.position_rad, loop.position_rad(), 0.01) << skipped;
    EXPECT_EQ(after.ordered_reference.position_rad, after.reference.position_rad) << skipped;
    EXPECT_GT(after.reference.position_rad, before.reference.position_rad) << skipped;
  }
}

}  // namespace
}  // namespace strainwave::testing
