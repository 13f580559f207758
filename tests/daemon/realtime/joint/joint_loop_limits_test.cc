// SPDX-License-Identifier: BSD-3-Clause
// The drive's faults and the joint's limits, which end a motion.
#include <gtest/gtest.h>

#include <limits>

#include "tests/daemon/realtime/joint/scripted_joint.h"

namespace strainwave::testing {
namespace {

using JointLoopLimits = ScriptedJoint;

TEST_F(JointLoopLimits, TurnEveryFaultOfTheDriveIntoTheJointsWithinOneCycle) {
  const std::pair<ActuatorFault, Fault> pairs[]{
      {ActuatorFault::kReadFailed, Fault::kReadFailed},
      {ActuatorFault::kWriteRefused, Fault::kWriteRefused},
      {ActuatorFault::kDriveFault, Fault::kDriveFault},
      {ActuatorFault::kPowerLost, Fault::kPowerLost},
      {ActuatorFault::kImplausible, Fault::kImplausibleReading},
      {ActuatorFault::kConnectionLost, Fault::kConnectionLost},
      {ActuatorFault::kEmergencyStop, Fault::kEmergencyStop},
      {ActuatorFault::kDriveRestarted, Fault::kDriveRestarted},
      {ActuatorFault::kBusError, Fault::kBusError},
  };
  for (const auto& [drive_fault, expected] : pairs) {
    drive_->reading.drive_state = DriveState::kDisabled;
    hold();
    drive_->reading.fault = drive_fault;
    EXPECT_EQ(cycles_until_fault(1), 1);
    EXPECT_EQ(fault(), expected);
    EXPECT_FALSE(drive_->last.enable);
    drive_->reading.drive_state = DriveState::kDisabled;
    ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
    EXPECT_EQ(loop_->mode(), Mode::kOff);
  }
}

TEST_F(JointLoopLimits, KeepTheDrivesOwnErrorNumberWithTheFaultThatItExplains) {
  hold();
  drive_->reading.fault = ActuatorFault::kDriveFault;
  drive_->reading.drive_error = 0x3210;
  step();
  drive_->reading.drive_error = 0x8130;  // a later error explains nothing
  step();
  EXPECT_EQ(loop_->record().state.drive_error, 0x3210);
  LoopEvent event;
  while (bench_->events().pop(event) && event.to != Mode::kFaulted) continue;
  EXPECT_EQ(event.drive_error, 0x3210U);
}

TEST_F(JointLoopLimits, LetASilentDriveSayItsFaultWhenSomebodyEnablesIt) {
  hold();
  order(OrderKind::kDisable);
  while (loop_->mode() != Mode::kOff) step();
  drive_->reading.has_position = false;
  for (int i = 0; i <= config_.missed_readings_limit; ++i) step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kDriveNotReady);
  drive_->reading.fault = ActuatorFault::kDriveRestarted;
  step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  EXPECT_EQ(fault(), Fault::kDriveRestarted);
  EXPECT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
}

TEST_F(JointLoopLimits, StopTheDriveAgainUntilItHasObeyed) {
  hold();
  drive_->reading.fault = ActuatorFault::kDriveFault;
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(drive_->stops, 10) << "the drive still says that it is enabled";
  drive_->reading.drive_state = DriveState::kDisabled;
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(drive_->stops, 10);
}

TEST_F(JointLoopLimits, TolerateAsManyMissedReadingsAsConfigured) {
  hold();
  drive_->reading.has_position = false;
  for (int i = 0; i < config_.missed_readings_limit; ++i) {
    step();
    EXPECT_EQ(fault(), Fault::kNone);
    EXPECT_NE(loop_->record().state.notices & static_cast<int>(Notice::kReadingMissed), 0);
  }
  step();
  EXPECT_EQ(fault(), Fault::kReadFailed);
}

TEST_F(JointLoopLimits, LatchTheStartTimeout) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  EXPECT_NEAR(cycles_until_fault(1000), 100, 1);
  EXPECT_EQ(fault(), Fault::kStartTimeout);
  ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drive_->reading.drive_state = DriveState::kEnabled;
  drive_->reading.brake_shut = true;
  step();
  EXPECT_EQ(loop_->mode(), Mode::kReleasing);
  EXPECT_NE(cycles_until_fault(1000), 0);
  EXPECT_EQ(fault(), Fault::kStartTimeout) << "by a brake that does not open";
}

TEST_F(JointLoopLimits, LatchTheStopTimeout) {
  hold();
  drive_->drifting_rad_s = 0.2;  // the load moves it on, whatever the torque
  for (int i = 0; i < 50; ++i) step();
  ASSERT_EQ(fault(), Fault::kNone);
  ASSERT_EQ(order(OrderKind::kDisable), Reason::kAccepted);
  ASSERT_EQ(loop_->mode(), Mode::kStopping);
  EXPECT_NEAR(cycles_until_fault(1000), 200, 2);
  EXPECT_EQ(fault(), Fault::kStopTimeout);
}

TEST_F(JointLoopLimits, LatchThePositionLimit) {
  drive_->reading.joint_position_rad =
      config_.limits.position_max_rad + config_.limits.position_margin_rad - 0.001;
  stand();
  hold();
  step();
  EXPECT_EQ(fault(), Fault::kNone);
  drive_->reading.joint_position_rad += 0.002;
  EXPECT_EQ(cycles_until_fault(1), 1);
  EXPECT_EQ(fault(), Fault::kPositionLimit);
}

TEST_F(JointLoopLimits, LeaveAJointThatIsOffAloneWhateverItsDriveSays) {
  drive_->reading.fault = ActuatorFault::kPowerLost;
  drive_->reading.joint_position_rad = 100.0;
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(loop_->mode(), Mode::kOff);
  drive_->reading.has_position = false;
  drive_->reading.fault = ActuatorFault::kNone;
  for (int i = 0; i <= config_.missed_readings_limit; ++i) step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kDriveNotReady);
}

TEST_F(JointLoopLimits, EnableADriveWhosePositionIsMissingInThisVeryPeriod) {
  drive_->reading.has_position = false;
  for (int i = 0; i < 2; ++i) step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drive_->reading.drive_state = DriveState::kEnabled;
  step();
  EXPECT_EQ(loop_->mode(), Mode::kStarting) << "nobody takes a joint over without its position";
  drive_->reading.has_position = true;
  step();
  EXPECT_EQ(loop_->mode(), Mode::kHolding);
}

}  // namespace
}  // namespace strainwave::testing
