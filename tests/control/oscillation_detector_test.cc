// SPDX-License-Identifier: BSD-3-Clause
// Reversals of the feedback, counted over the last second.
#include "control/oscillation_detector.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kLimit_Nm = 1.0;

// A square wave that changes its sign every `half_periods`.
void swing(OscillationDetector& detector, double torque_Nm, int half_periods, int periods) {
  for (int k = 0; k < periods; ++k)
    detector.step((k / half_periods) % 2 == 0 ? torque_Nm : -torque_Nm, 0.0, kLimit_Nm, 1);
}

TEST(OscillationDetector, TellsAHundredReversalsPerSecondWithinHalfASecondUntilItIsReset) {
  OscillationDetector detector(kPeriod_s);
  swing(detector, 3.0, 10, 500);
  EXPECT_TRUE(detector.oscillates());
  EXPECT_DOUBLE_EQ(detector.swing_Nm(), 3.0);
  for (int k = 0; k < 5000; ++k) detector.step(0.0, 0.0, kLimit_Nm, 1);
  EXPECT_TRUE(detector.oscillates());
  detector.reset();
  EXPECT_FALSE(detector.oscillates());
  EXPECT_EQ(detector.reversals_per_s(), 0.0);
}

TEST(OscillationDetector, TakesASlowReversalForNone) {
  OscillationDetector detector(kPeriod_s);
  swing(detector, 3.0, 50, 20000);
  EXPECT_FALSE(detector.oscillates());
}

TEST(OscillationDetector, TakesALinkThatSwingsOutInAFifthOfASecondForNone) {
  OscillationDetector detector(kPeriod_s);
  swing(detector, 3.0, 6, 170);
  for (int k = 0; k < 1000; ++k) detector.step(0.0, 0.0, kLimit_Nm, 1);
  EXPECT_FALSE(detector.oscillates());
}

TEST(OscillationDetector, TakesSwingsWithinTheLimitAndATorqueOfOneSideForNoise) {
  OscillationDetector small(kPeriod_s), one_sided(kPeriod_s);
  swing(small, kLimit_Nm, 5, 5000);
  for (int k = 0; k < 5000; ++k) one_sided.step(k / 5 % 2 == 0 ? 3.0 : 0.0, 0.0, kLimit_Nm, 1);
  EXPECT_FALSE(small.oscillates());
  EXPECT_EQ(small.reversals_per_s(), 0.0);
  EXPECT_FALSE(one_sided.oscillates());
  EXPECT_EQ(one_sided.reversals_per_s(), 0.0);
}

}  // namespace
}  // namespace strainwave
