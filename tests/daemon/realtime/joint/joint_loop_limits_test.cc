// SPDX-License-Identifier: BSD-3-Clause
// What ends a motion: the drive's faults and the joint's limits.
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
  drive_->reading.drive_error = 0x8130;  // what follows explains nothing
  step();
  EXPECT_EQ(loop_->record().state.drive_error, 0x3210);
  LoopEvent event;
  while (events_.pop(event) && event.to != Mode::kFaulted) continue;
  EXPECT_EQ(event.drive_error, 0x3210U);
}

TEST(JointLoopMissedReadings, DoNotDisturbAMotionAtFullSpeed) {
  for (const int missing : {1, 2, 3}) {
    JointBench bench({demo_joint()});
    bench.bring_to_hold(0);
    ASSERT_EQ(bench.move(0, 1.0), Reason::kAccepted);
    const double full_speed_rad_s = demo_joint().loop.controller.motion.velocity_rad_s;
    ASSERT_GE(
        bench.step_until([&] { return bench.state(0).joint_velocity_rad_s > 0.98 * full_speed_rad_s; }, 500),
        0);
    bench.drive(0).miss_readings(missing);
    bench.run(1.0);
    EXPECT_EQ(bench.fault(0), Fault::kNone) << missing << ": " << to_text(bench.fault(0));
    EXPECT_NEAR(bench.state(0).joint_position_rad, 1.0, 1e-4) << missing;
  }
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

TEST_F(JointLoopLimits, LeaveAReleasedEmergencyStopWithoutMotion) {
  hold();
  drive_->reading.fault = ActuatorFault::kEmergencyStop;
  step();
  drive_->reading.fault = ActuatorFault::kNone;
  drive_->reading.drive_state = DriveState::kDisabled;
  for (int i = 0; i < 5000; ++i) {
    step();
    ASSERT_EQ(loop_->mode(), Mode::kFaulted);
    ASSERT_FALSE(drive_->last.enable);
  }
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
}

TEST_F(JointLoopLimits, LatchTheStopTimeout) {
  hold();
  drifting_rad_s_ = 0.2;  // the load drives it on, whatever the torque
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
