// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/sliding_window.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(RecentPeak, IsSeenForAMinuteAndNotForTwo) {
  RecentPeak peak;
  peak.take(0.1, 1000.0);
  peak.take(-3.0, 1001.0);
  peak.take(0.2, 1002.0);
  for (double later_s = 2.0; later_s <= 60.0; later_s += 1.0) EXPECT_EQ(peak.amount(1001.0 + later_s), 3.0);
  EXPECT_EQ(peak.amount(1120.0), 0.0);
}

TEST(RecentPeak, ForgetsWhatWasInASlotBefore) {
  RecentPeak peak;
  peak.take(3.0, 0.0);
  // Uses the same slot one turn later.
  peak.take(1.0, 70.0);
  EXPECT_EQ(peak.amount(70.0), 1.0);
}

}  // namespace
}  // namespace strainwave
