// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/mode_machine.h"

#include <gtest/gtest.h>

#include <array>

namespace strainwave {
namespace {

constexpr std::array kModes{Mode::kOff,      Mode::kStarting, Mode::kHolding, Mode::kTracking,
                            Mode::kStopping, Mode::kFaulted,  Mode::kHoming,  Mode::kReleasing};
constexpr std::array kEvents{ModeEvent::kEnableOrdered,    ModeEvent::kDriveReady,
                             ModeEvent::kSetpointAccepted, ModeEvent::kArrived,
                             ModeEvent::kDisableOrdered,   ModeEvent::kStopped,
                             ModeEvent::kFaultRaised,      ModeEvent::kFaultCleared,
                             ModeEvent::kHomeOrdered,      ModeEvent::kTorqueReady};

TEST(ModeMachine, FaultsFromEveryMode) {
  for (const Mode mode : kModes) EXPECT_EQ(next_mode(mode, ModeEvent::kFaultRaised), Mode::kFaulted);
}

TEST(ModeMachine, LeavesFaultedOnlyByAClearAndOnlyToOff) {
  for (const ModeEvent event : kEvents) {
    const auto next = next_mode(Mode::kFaulted, event);
    if (event == ModeEvent::kFaultCleared)
      EXPECT_EQ(next, Mode::kOff);
    else
      EXPECT_TRUE(!next || *next == Mode::kFaulted);
  }
}

TEST(ModeMachine, StartsOnlyByAnEnableOrder) {
  for (const Mode mode : kModes)
    for (const ModeEvent event : kEvents)
      if (next_mode(mode, event) == Mode::kStarting) {
        EXPECT_EQ(mode, Mode::kOff);
        EXPECT_EQ(event, ModeEvent::kEnableOrdered);
      }
}

TEST(ModeMachine, TracksOnlyFromUnderControlAndOnlyByASetpoint) {
  for (const Mode mode : kModes)
    for (const ModeEvent event : kEvents)
      if (next_mode(mode, event) == Mode::kTracking) {
        EXPECT_EQ(event, ModeEvent::kSetpointAccepted);
        EXPECT_TRUE(mode == Mode::kHolding || mode == Mode::kTracking);
      }
}

TEST(ModeMachine, LooksForHomeOnlyFromHoldingAndOnlyByAnOrder) {
  for (const Mode mode : kModes)
    for (const ModeEvent event : kEvents)
      if (next_mode(mode, event) == Mode::kHoming) {
        EXPECT_EQ(event, ModeEvent::kHomeOrdered);
        EXPECT_EQ(mode, Mode::kHolding);
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

TEST(ModeMachine, TakesNoSetpointWhileItLooksForHome) {
  EXPECT_FALSE(next_mode(Mode::kHoming, ModeEvent::kSetpointAccepted));
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

}  // namespace
}  // namespace strainwave
