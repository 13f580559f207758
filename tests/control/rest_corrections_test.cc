// SPDX-License-Identifier: BSD-3-Clause
// Small motions of a joint that rests beside its place.
#include "control/rest_corrections.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kCount_rad = 1e-5;

// How many corrections begin in two seconds of rest so far off.
int begun(RestCorrections& corrections, double off_rad, int still_periods = 100) {
  int count = 0;
  for (int k = 0; k < 2000; ++k) count += corrections.begins(off_rad, still_periods) ? 1 : 0;
  return count;
}

TEST(RestCorrections, LeaveAJointAloneThatIsWithinACountOrStillMoves) {
  RestCorrections corrections(1e-3, kCount_rad);
  EXPECT_EQ(begun(corrections, kCount_rad), 0);
  EXPECT_EQ(begun(corrections, 5.0 * kCount_rad, 0), 0);
  EXPECT_FALSE(corrections.begun());
}

TEST(RestCorrections, AreAFewForEachOrder) {
  RestCorrections corrections(1e-3, kCount_rad);
  const int first = begun(corrections, 3.0 * kCount_rad);
  EXPECT_GE(first, 1);
  EXPECT_LE(first, 10);
  EXPECT_EQ(begun(corrections, 3.0 * kCount_rad), 0);
  corrections.reset();
  EXPECT_FALSE(corrections.begun());
  EXPECT_EQ(begun(corrections, 3.0 * kCount_rad), first);
}

TEST(RestCorrections, FeedForwardMoreFrictionWhereOneFallsShortAndLessWhereOneGoesTooFar) {
  RestCorrections falls_short(1e-3, kCount_rad), too_far(1e-3, kCount_rad);
  begun(falls_short, 3.0 * kCount_rad);
  EXPECT_GT(falls_short.friction_share(), 0.0);
  EXPECT_LT(falls_short.friction_share(), 1.0);
  for (int k = 0; k < 30 && !too_far.begins(3.0 * kCount_rad, 100); ++k) {
  }
  for (int k = 0; k < 30 && !too_far.begins(-3.0 * kCount_rad, 100); ++k) {
  }
  EXPECT_LT(too_far.friction_share(), 0.0);
}

}  // namespace
}  // namespace strainwave
