// SPDX-License-Identifier: BSD-3-Clause
// Every way in which an ODrive can fail: the reaction and the recovery.
#include <limits>

#include "tests/drivers/can/odrive/odrive_driver.h"

namespace strainwave::testing {
namespace {

using OdriveFailure = OdriveDriver;

TEST_F(OdriveFailure, ReportsTheDrivesErrorsByName) {
  start_moving();
  tell("error 0x2000");
  EXPECT_NE(periods_until_fault(102), 0);  // the heartbeat reports the error
  EXPECT_EQ(reading_.fault, ActuatorFault::kDriveFault);
  EXPECT_EQ(odrive::drive_error_text(reading_.drive_error), "MOTOR_OVER_TEMP");
  run(500, kMoving);
  EXPECT_EQ(reading_.fault, ActuatorFault::kDriveFault) << "latched";
  run(10, kOff);
  joint_->clear_fault();
  run(10, kOff);
  EXPECT_EQ(axis_->errors(), 0U);
  ASSERT_TRUE(enable());
}

TEST_F(OdriveFailure, SeesAnUnderVoltageAndAnEmergencyStopAsSuch) {
  start_moving();
  tell("bus 5");
  EXPECT_NE(periods_until_fault(102), 0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kPowerLost);
  tell("bus 48");
  run(10, kOff);
  joint_->clear_fault();
  ASSERT_TRUE(enable());
  tell("error 0x2000000");
  EXPECT_NE(periods_until_fault(102), 0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kEmergencyStop);
}

TEST_F(OdriveFailure, TakesTheTorqueAwayWhenPositionsAreMissingAndThenFails) {
  start_moving();
  tell("skip-encoder 1000");
  run(config_.zero_torque_after + 1, kMoving);
  EXPECT_NE(axis_->torque_Nm(), 0.0);
  run(2, kMoving);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kNone);
  EXPECT_NE(periods_until_fault(config_.fault_after), 0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kReadFailed);
  EXPECT_EQ(detail(), CanDetail::kPositionMissing);
}

TEST_F(OdriveFailure, TakesNoPositionThatIsNoNumber) {
  start_moving();
  tell("bad-encoder on");
  EXPECT_NE(periods_until_fault(20), 0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kReadFailed);
  EXPECT_TRUE(std::isfinite(reading_.joint_position_rad));
}

TEST_F(OdriveFailure, LosesTheLinkWhenTheCableIsCutAndTheWatchdogStopsTheDrive) {
  start_moving();
  tell("cut");
  EXPECT_NE(periods_until_fault(20), 0);
  run(150, kMoving);
  EXPECT_EQ(axis_->errors(), can_nodes::kOdriveWatchdogExpired);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveFailure, IsSetUpAgainAfterALostLinkOnAnOperatorsOrderOnly) {
  start();
  run(100, kOff);
  tell("heartbeat off");
  run(400, {0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kConnectionLost);
  EXPECT_EQ(detail(), CanDetail::kHeartbeatMissing);
  tell("heartbeat on");
  run(200, {0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kConnectionLost) << "latched";
  run(10, kOff);
  tell("firmware 0 5 6");  // another drive was connected
  joint_->clear_fault();
  bus_->serve();
  run(10, kOff);
  EXPECT_EQ(detail(), CanDetail::kSetupFailed);
  tell("firmware 0 6 10");
  joint_->clear_fault();
  bus_->serve();
  run(10, kOff);
  EXPECT_EQ(reading_.fault, ActuatorFault::kNone);
  EXPECT_TRUE(enable());
}

TEST_F(OdriveFailure, SeesAnAxisThatNeverReachesClosedLoop) {
  start();
  tell("arming off");
  for (int i = 0; i < 1100 && reading_.fault == ActuatorFault::kNone; ++i) step({0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kDriveFault);
  EXPECT_EQ(detail(), CanDetail::kEnableStep);
}

TEST_F(OdriveFailure, SeesADriveThatRestartedAndDoesNotEnableItByItself) {
  start_moving();
  tell("reboot 40");
  EXPECT_NE(periods_until_fault(200), 0);
  run(1000, kMoving);
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveFailure, RefusesATorqueThatIsNoNumber) {
  start_moving();
  step({std::numeric_limits<double>::quiet_NaN(), true});
  step(kMoving);
  EXPECT_EQ(reading_.fault, ActuatorFault::kWriteRefused);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveFailure, CarriesThePositionOverAPeriodWithoutOneAndNoFurther) {
  start_moving();
  tell("skip-encoder 2");
  step(kMoving);
  ASSERT_TRUE(reading_.has_position);
  const double period_of_motion_rad = axis_->plant().state().velocity_rad_s * 1e-3;
  EXPECT_NEAR(reading_.joint_position_rad, axis_->plant().state().position_rad, 0.25 * period_of_motion_rad);
  EXPECT_EQ(reading_.drive_state, DriveState::kEnabled);
  step(kMoving);
  EXPECT_FALSE(reading_.has_position);
}

TEST_F(OdriveFailure, CountsFramesOfTheWrongSize) {
  start();
  run(10, kOff);
  CanFrame frame;
  frame.id = odrive::can_id(odrive::Command::kEstimates, 2);
  frame.size = 7;
  tell("skip-encoder 2");
  can_.send_as_stranger(frame);
  step(kOff);
  step(kOff);
  EXPECT_FALSE(reading_.has_position);
}

}  // namespace
}  // namespace strainwave::testing
