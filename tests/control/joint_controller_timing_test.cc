// SPDX-License-Identifier: BSD-3-Clause
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
  bool oscillates = false;
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
    result.oscillates = loop.step().oscillates;
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
    EXPECT_FALSE(told.oscillates) << periods;
    EXPECT_TRUE(untold.overshoot_rad > 2.0 * told.overshoot_rad || untold.oscillates)
        << periods << ": it is the knowledge that helps";
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

TEST(JointControllerTiming, GoesOnFromWhereTheJointIsAfterALongGap) {
  for (const int skipped : {20, 80}) {
    ControlledJoint loop;
    loop.controller().set_target(10.0, 2.0);
    loop.run(1.0);
    loop.skip(skipped);
    const double from_rad = loop.position_rad();
    const JointStep after = loop.step();
    EXPECT_NEAR(after.reference.position_rad, from_rad, 0.01) << skipped;
    loop.run(6.0);
    EXPECT_NEAR(loop.position_rad(), 10.0, 1e-3) << skipped;
  }
}

}  // namespace
}  // namespace strainwave::testing
