// SPDX-License-Identifier: BSD-3-Clause
// The checks of the ODrive driver at start-up, and its orders.
#include "tests/drivers/can/odrive/odrive_driver.h"

namespace strainwave::testing {
namespace {

TEST_F(OdriveDriver, TellsWhatItFoundAndLeavesTheAxisIdle) {
  start();
  const std::vector<std::string> messages = bus_->take_messages();
  ASSERT_GE(messages.size(), 3U);
  EXPECT_EQ(messages[1], "elbow: ODrive node 2: firmware 0.6.10");
  EXPECT_EQ(messages[2], "elbow: ODrive node 2: its watchdog stops it after 0.100 s");
  run(100, kOff);
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
  EXPECT_EQ(reading_.drive_state, DriveState::kDisabled);
}

TEST_F(OdriveDriver, RefusesAnotherFirmware) {
  node_config_.version.firmware = {0, 5, 6};
  EXPECT_NE(refusal().find("firmware = 0.5.6: must be 0.6"), std::string::npos);
}

TEST_F(OdriveDriver, RefusesANodeThatDoesNotAnswer) {
  node_config_.node_id = 3;
  EXPECT_NE(refusal().find("does not give its version"), std::string::npos);
}

TEST_F(OdriveDriver, RefusesAWatchdogThatIsOffOrTooSlow) {
  node_config_.watchdog_enabled = false;
  EXPECT_NE(refusal().find("enable_watchdog = False"), std::string::npos);
}

TEST_F(OdriveDriver, RefusesASlowWatchdog) {
  node_config_.watchdog_timeout_s = 3.0;
  EXPECT_NE(refusal().find("watchdog_timeout = 3.0"), std::string::npos);
}

TEST_F(OdriveDriver, SaysThatAnUnknownWatchdogWasNotVerified) {
  config_.watchdog.reset();
  start();
  EXPECT_NE(bus_->take_messages().at(2).find("was NOT verified"), std::string::npos);
}

TEST_F(OdriveDriver, RefusesEncoderMessagesThatAreTooRare) {
  node_config_.encoder_us = 10000;
  EXPECT_NE(refusal().find("encoder_msg_rate_ms"), std::string::npos);
}

TEST_F(OdriveDriver, RefusesAMissingTemperature) {
  node_config_.temperature_us = 0;
  EXPECT_NE(refusal().find("temperature_msg_rate_ms"), std::string::npos);
}

class OdriveDirection : public OdriveDriver, public ::testing::WithParamInterface<double> {};

TEST_P(OdriveDirection, TurnsTheJointWithTheOrderedTorqueWhicheverWayTheDriveCounts) {
  config_.units.direction = GetParam() > 0.0 ? 1 : -1;
  node_config_.joint_turns_per_encoder_turn *= GetParam();
  node_config_.joint_torque_per_drive_torque *= GetParam();
  start();
  ASSERT_TRUE(enable());
  run(60, kMoving);
  EXPECT_NEAR(axis_->torque_Nm(), 10.0, 1e-5);
  EXPECT_GT(reading_.joint_position_rad, 0.0);
  // The position was sampled within the last period, with 320000 counts a turn.
  const JointState& joint = axis_->plant().state();
  EXPECT_NEAR(reading_.joint_position_rad, joint.position_rad, joint.velocity_rad_s * 1.5e-3 + 2e-5);
  EXPECT_TRUE(reading_.has_temperature);
  EXPECT_NEAR(reading_.temperature_C, 25.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Signs, OdriveDirection, ::testing::Values(1.0, -1.0));

TEST_F(OdriveDriver, NeverOrdersMoreThanTheLimit) {
  config_.torque_limit_Nm = 5.0;
  start_moving();
  EXPECT_NEAR(axis_->torque_Nm(), 5.0, 1e-5);
}

TEST_F(OdriveDriver, SetsTorqueModeWheneverItEnables) {
  start_moving();
  run(400, kOff);
  ASSERT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
  tell("mode 3 1");
  reading_ = {};
  ASSERT_TRUE(enable());
  run(5, kMoving);
  EXPECT_NEAR(axis_->torque_Nm(), 10.0, 1e-5);
}

TEST_F(OdriveDriver, TakesTheTorqueAwayAtOnceWhenItDisables) {
  start_moving();
  run(2, kOff);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
}

}  // namespace
}  // namespace strainwave::testing
