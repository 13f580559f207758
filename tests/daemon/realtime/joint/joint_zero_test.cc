// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_zero.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(JointZero, OfAJointThatNeedsNoHomingIsTheDrivesFromTheStart) {
  const JointZero zero(false);
  EXPECT_TRUE(zero.known());
  EXPECT_EQ(zero.to_joint_rad(0.7), 0.7);
}

TEST(JointZero, IsUnknownUntilItIsFoundAndAfterCountsMayBeMissing) {
  JointZero zero(true);
  EXPECT_FALSE(zero.known());
  zero.set(-0.4, 0.3);
  EXPECT_TRUE(zero.known());
  zero.forget();
  EXPECT_FALSE(zero.known());
}

TEST(JointZero, GivesThePlaceThatWasFoundItsNameAndGoesBothWays) {
  JointZero zero(true);
  zero.set(-0.4, 0.3);
  EXPECT_DOUBLE_EQ(zero.to_joint_rad(-0.4), 0.3);
  for (const double joint_rad : {-3.0, 0.0, 1.25})
    EXPECT_DOUBLE_EQ(zero.to_joint_rad(zero.to_drive_rad(joint_rad)), joint_rad);
}

TEST(JointZero, CanBeCorrectedByHomingThatIsNotRequired) {
  JointZero zero(false);
  zero.set(0.5, 0.0);
  EXPECT_DOUBLE_EQ(zero.to_joint_rad(0.5), 0.0);
  zero.forget();
  EXPECT_TRUE(zero.known()) << "nobody asked for homing";
}

}  // namespace
}  // namespace strainwave
