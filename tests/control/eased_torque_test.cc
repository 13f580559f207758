#include "control/eased_torque.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(EasedTorque, ChangesByTheLeastOverASmallDistanceAndTwiceAsMuchOverTheDoubled) {
  EasedTorque eased;
  eased.follow(0.8, 0.5, 4.0, 1);
  EXPECT_DOUBLE_EQ(eased.value_Nm(), 0.5 * (1.0 + 0.04));
  eased.jump_to(0.0);
  eased.follow(-4.0, 0.5, 4.0, 1);
  EXPECT_DOUBLE_EQ(eased.value_Nm(), -1.0);
}

TEST(EasedTorque, AnswersAllOfAPushInAPeriodOrFew) {
  EasedTorque eased;
  eased.follow(30.0, 0.5, 4.0, 1);
  EXPECT_GT(eased.value_Nm(), 28.0);
  eased.follow(30.0, 0.5, 4.0, 12);
  EXPECT_EQ(eased.value_Nm(), 30.0);
}

TEST(EasedTorque, FollowsOverPeriodsThatWereLeftOut) {
  EasedTorque eased;
  eased.follow(1.9, 0.5, 4.0, 3);
  EXPECT_GT(eased.value_Nm(), 1.5);
  EXPECT_LE(eased.value_Nm(), 1.9);
}

}  // namespace
}  // namespace strainwave
