// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_mode.h"

#include <gtest/gtest.h>

#include <array>

namespace strainwave {
namespace {

constexpr std::array kModes{Mode::kOff,      Mode::kStarting, Mode::kHolding, Mode::kTracking,
                            Mode::kStopping, Mode::kFaulted,  Mode::kHoming,  Mode::kReleasing};
constexpr std::array kEvents{
    ModeEvent::kEnableOrdered, ModeEvent::kDriveReady,     ModeEvent::kSetpointAccepted,
    ModeEvent::kArrived,       ModeEvent::kDisableOrdered, ModeEvent::kStopped,
    ModeEvent::kFaultCleared,  ModeEvent::kHomeOrdered,    ModeEvent::kTorqueReady};

TEST(ModeMachine, LeavesFaultedOnlyByAClearAndOnlyToOff) {
  for (const ModeEvent event : kEvents) {
    const auto next = next_mode(Mode::kFaulted, event);
    if (event == ModeEvent::kFaultCleared)
      EXPECT_EQ(next, Mode::kOff);
    else
      EXPECT_TRUE(!next || *next == Mode::kFaulted);
  }
}

TEST(ModeMachine, StartsTracksAndHomesOnlyByTheOrderForItAndOnlyFromWhereItMay) {
  for (const Mode mode : kModes)
    for (const ModeEvent event : kEvents) {
      const auto next = next_mode(mode, event);
      if (next == Mode::kStarting) {
        EXPECT_EQ(mode, Mode::kOff);
        EXPECT_EQ(event, ModeEvent::kEnableOrdered);
      } else if (next == Mode::kHoming) {
        EXPECT_EQ(mode, Mode::kHolding);
        EXPECT_EQ(event, ModeEvent::kHomeOrdered);
      } else if (next == Mode::kTracking) {
        EXPECT_TRUE(mode == Mode::kHolding || mode == Mode::kTracking);
        EXPECT_EQ(event, ModeEvent::kSetpointAccepted);
      }
    }
}

TEST(ModeMachine, TakesNoMotionBeforeTheBrakeIsOpen) {
  EXPECT_EQ(next_mode(Mode::kStarting, ModeEvent::kTorqueReady), Mode::kReleasing);
  EXPECT_FALSE(next_mode(Mode::kReleasing, ModeEvent::kSetpointAccepted));
  EXPECT_FALSE(next_mode(Mode::kReleasing, ModeEvent::kHomeOrdered));
  EXPECT_EQ(next_mode(Mode::kReleasing, ModeEvent::kDriveReady), Mode::kHolding);
  EXPECT_TRUE(is_controlled(Mode::kReleasing)) << "the torque holds the position";
}

TEST(ModeMachine, TakesNoTorqueFromAControlledJointBeforeItCameToRest) {
  for (const Mode mode : kModes)
    for (const ModeEvent event : kEvents)
      if (is_controlled(mode) && event != ModeEvent::kStopped) {
        EXPECT_NE(next_mode(mode, event), Mode::kOff)
            << static_cast<int>(mode) << " by " << static_cast<int>(event);
      }
}

TEST(ModeMachine, ObeysADisableInEveryMode) {
  for (const Mode mode : kModes) EXPECT_TRUE(next_mode(mode, ModeEvent::kDisableOrdered).has_value());
}

TEST(ModeMachine, ReachesOffFromEveryModeByDisableAndStandstill) {
  for (const Mode mode : kModes) {
    if (mode == Mode::kFaulted) continue;
    Mode now = *next_mode(mode, ModeEvent::kDisableOrdered);
    if (now == Mode::kStopping) now = *next_mode(now, ModeEvent::kStopped);
    EXPECT_EQ(now, Mode::kOff);
  }
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
  EXPECT_FALSE(mode.latch(Fault::kConnectionLost, 0x8130, 3));
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
