#include "control/eased_disturbance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kLeast_Nm = 0.1;
constexpr double kCount_Nm = 2.0;

/// Periods until what is fed forward is the estimate, from 0.
int periods_until_there(double load_Nm) {
  EasedDisturbance eased;
  for (int k = 1; k < 1000; ++k) {
    eased.follow({0.0, load_Nm}, kLeast_Nm, kCount_Nm, 1);
    if (eased.value().load_Nm == load_Nm) return k;
  }
  return -1;
}

TEST(EasedDisturbance, MovesByLittleMoreThanTheLeastWhereACountDoesNotSayMore) {
  EasedDisturbance eased;
  eased.follow({0.0, 0.5 * kCount_Nm}, kLeast_Nm, kCount_Nm, 1);
  EXPECT_DOUBLE_EQ(eased.value().load_Nm, 1.25 * kLeast_Nm);
  eased.follow({0.0, -0.5 * kCount_Nm}, kLeast_Nm, kCount_Nm, 1);
  EXPECT_LT(eased.value().load_Nm, 0.0);
  EXPECT_EQ(eased.value().friction_offset_Nm, 0.0);
}

TEST(EasedDisturbance, ReachesAGreatLoadNoLaterThanASmallOne) {
  const int count = periods_until_there(kCount_Nm);
  EXPECT_GT(count, 10);
  for (const double counts : {3.0, 10.0, 30.0, -10.0}) {
    const int periods = periods_until_there(counts * kCount_Nm);
    EXPECT_GT(periods, 0) << counts;
    EXPECT_LE(periods, 2 * count) << counts;
  }
}

TEST(EasedDisturbance, PassesNoneOfWhatItFollows) {
  EasedDisturbance eased;
  eased.jump_to({0.3, -1.0});
  for (int k = 0; k < 100; ++k) {
    eased.follow({0.1, 40.0}, kLeast_Nm, kCount_Nm, 3);
    ASSERT_LE(eased.value().load_Nm, 40.0);
    ASSERT_GE(eased.value().friction_offset_Nm, 0.1);
  }
  EXPECT_EQ(eased.value().load_Nm, 40.0);
  EXPECT_EQ(eased.value().friction_offset_Nm, 0.1);
}

TEST(EasedDisturbance, MayChangeByAsManyTimesAsPeriodsHavePassed) {
  EasedDisturbance one, three;
  one.follow({kCount_Nm, 0.0}, kLeast_Nm, kCount_Nm, 1);
  three.follow({kCount_Nm, 0.0}, kLeast_Nm, kCount_Nm, 3);
  EXPECT_DOUBLE_EQ(three.value().friction_offset_Nm, 3.0 * one.value().friction_offset_Nm);
}

}  // namespace
}  // namespace strainwave
