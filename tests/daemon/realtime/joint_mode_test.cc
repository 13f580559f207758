// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint_mode.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(JointMode, BeginsOffWithoutAFault) {
  const JointMode mode;
  EXPECT_EQ(mode.mode(), Mode::kOff);
  EXPECT_EQ(mode.fault(), Fault::kNone);
  EXPECT_EQ(mode.faults_total(), 0);
  EXPECT_FALSE(mode.controlled());
}

TEST(JointMode, StaysWhatItIsWhenAnEventMeansNothing) {
  JointMode mode;
  EXPECT_FALSE(mode.apply(ModeEvent::kSetpointAccepted, 1));
  EXPECT_FALSE(mode.apply(ModeEvent::kFaultCleared, 1));
  EXPECT_EQ(mode.mode(), Mode::kOff);
}

TEST(JointMode, CountsItsTimeFromTheChangeAndNotFromARepetition) {
  JointMode mode;
  ASSERT_TRUE(mode.apply(ModeEvent::kEnableOrdered, 1'000'000'000));
  ASSERT_TRUE(mode.apply(ModeEvent::kDriveReady, 2'000'000'000));
  ASSERT_TRUE(mode.apply(ModeEvent::kSetpointAccepted, 3'000'000'000));
  EXPECT_TRUE(mode.began(3'000'000'000));
  ASSERT_TRUE(mode.apply(ModeEvent::kSetpointAccepted, 4'000'000'000));
  EXPECT_FALSE(mode.began(4'000'000'000));
  EXPECT_DOUBLE_EQ(mode.seconds(4'500'000'000), 1.5);
}

TEST(JointMode, KeepsTheFirstFaultAndTheDrivesNumberForIt) {
  JointMode mode;
  ASSERT_TRUE(mode.apply(ModeEvent::kEnableOrdered, 1));
  EXPECT_TRUE(mode.latch(Fault::kDriveFault, 0x3210, 2));
  EXPECT_FALSE(mode.latch(Fault::kLinkLost, 0x8130, 3));
  EXPECT_EQ(mode.fault(), Fault::kDriveFault);
  EXPECT_EQ(mode.drive_error(), 0x3210U);
  EXPECT_EQ(mode.faults_total(), 1);
  EXPECT_TRUE(mode.began(2));
}

TEST(JointMode, IsWithoutAFaultOnceItIsClearedAndCountsTheNext) {
  JointMode mode;
  ASSERT_TRUE(mode.apply(ModeEvent::kEnableOrdered, 1));
  ASSERT_TRUE(mode.latch(Fault::kPowerLost, 0, 2));
  ASSERT_TRUE(mode.apply(ModeEvent::kDisableOrdered, 3)) << "obeyed, and nothing to do";
  EXPECT_EQ(mode.fault(), Fault::kPowerLost);
  ASSERT_TRUE(mode.apply(ModeEvent::kFaultCleared, 4));
  EXPECT_EQ(mode.mode(), Mode::kOff);
  EXPECT_EQ(mode.fault(), Fault::kNone);
  ASSERT_TRUE(mode.latch(Fault::kGroup, 0, 5));
  EXPECT_EQ(mode.faults_total(), 2);
}

}  // namespace
}  // namespace strainwave
