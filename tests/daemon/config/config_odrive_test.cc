// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "daemon/config/config.h"
#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"

namespace strainwave {
namespace {

class OdriveConfigTest : public ConfigFileTest {
 protected:
  OdriveConfigTest() { testing::write_authorized_keys(folder_); }
  /// The example with `from` replaced; unchanged if `from` is empty.
  DaemonConfig read_with(const std::string& from = "", const std::string& to = "") {
    return read(replaced(example("odrive.toml"), from, to));
  }
  std::string error_after(const std::string& from, const std::string& to) {
    return error_of(replaced(example("odrive.toml"), from, to));
  }
};

TEST_F(OdriveConfigTest, TellsTheControllerTheEncoderTheDelayAndWhatTheSupplyLeaves) {
  const DaemonConfig config = read_with();
  ASSERT_EQ(config.joints.size(), 1U);
  EXPECT_EQ(config.joints[0].driver_resource, "can0 node 1");
  const JointControllerConfig& controller = config.joints[0].loop.controller;
  EXPECT_NEAR(controller.encoder_resolution_rad, 2 * std::numbers::pi / 320000, 1e-15);
  EXPECT_EQ(controller.delay_periods, 1);
  EXPECT_NEAR(controller.motor.stall_torque_Nm, 9.6 * 48 / 4.8, 1e-9);
  EXPECT_EQ(config.joints[0].drive_error_text(Fault::kDriveFault, 0x2000), "MOTOR_OVER_TEMP");
}

TEST_F(OdriveConfigTest, WantsABusOfItsOwn) {
  EXPECT_NE(error_after("sync = \"none\"", "sync = \"daemon\"").find("sync to \"none\""), std::string::npos);
  EXPECT_NE(error_after("sync = \"none\"", "sync = \"none\"\nheartbeat_s = 0.05").find("heartbeat_s"),
            std::string::npos);
}

TEST_F(OdriveConfigTest, TakesItsOwnNodeNumbersOnly) {
  EXPECT_NO_THROW(read_with("node_id = 1\nprotocol", "node_id = 0\nprotocol"));
  EXPECT_NE(error_after("node_id = 1\nprotocol", "node_id = 64\nprotocol").find("0 to 63"),
            std::string::npos);
}

TEST_F(OdriveConfigTest, RefusesAnEncoderThatDoesNotTurnWithTheMotor) {
  const std::string message =
      error_after("encoder_turns_per_joint_turn = 50", "encoder_turns_per_joint_turn = 1");
  for (const char* part :
       {"encoder_turns_per_joint_turn = 1", "joint.gear_ratio = 50", "joint.model = \"flexible\""})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(OdriveConfigTest, WantsEveryUnitAndSideSaid) {
  for (const char* line : {"encoder_turns_per_joint_turn = 50\n", "encoder_counts_per_joint_turn = 320000\n",
                           "torque_side = \"motor\"\n", "torque_constant_Nm_A = 0.192\n"})
    EXPECT_NE(error_after(line, "").find("required"), std::string::npos) << line;
}

TEST_F(OdriveConfigTest, RefusesKeysOfTheOtherProtocol) {
  const std::string message = error_after("torque_side", "rated_torque_unit = \"mNm\"\ntorque_side");
  EXPECT_NE(message.find("rated_torque_unit"), std::string::npos);
}

TEST_F(OdriveConfigTest, ReadsTheLoopThatTheDriveClosesAndWhetherItsOrdersFit) {
  const std::string position = "torque_side = \"motor\"\ndrive_mode = \"position\"";
  const auto drive_of = [](const DaemonConfig& config) {
    return std::get<odrive::DriveConfig>(config.buses[0].drives[0]);
  };
  const DaemonConfig config = read_with("torque_side = \"motor\"", position);
  EXPECT_EQ(drive_of(config).drive_mode, DriveMode::kPosition);
  EXPECT_EQ(config.joints[0].loop.controller.drive_mode, DriveMode::kPosition);
  EXPECT_EQ(config.joints[0].loop.controller.delay_periods, 0);
  // 6 rad/s are 47.7 turns of the motor per second, above the limit of 32.767.
  const std::string fast = replaced(replaced(example("odrive.toml"), "torque_side = \"motor\"", position),
                                    "speed_limit_rad_s = 4.0", "speed_limit_rad_s = 6.0");
  expect_mentions(error_of(fast), {"input_vel_scale", "686", "speed_limit_rad_s = 6"});
  const DaemonConfig scaled = read(replaced(fast, position, position + "\ninput_vel_scale = 500"));
  EXPECT_EQ(drive_of(scaled).units.velocity_units_per_turn_s, 500.0);
  EXPECT_NO_THROW(read(replaced(fast, "\"position\"", "\"velocity\"")));
  expect_mentions(
      error_after("torque_side = \"motor\"", "torque_side = \"joint\"\ndrive_mode = \"position\""),
      {"drive_mode", "32.767", "34 N.m"});
  expect_mentions(
      error_of(replaced(replaced(example("odrive.toml"), "torque_side = \"motor\"", position),
                        "torque_limit_Nm = 34", "torque_limit_Nm = 34\non_overload = \"hold_load\"")),
      {"drive_mode", "hold_load"});
}

TEST_F(OdriveConfigTest, WantsBothEndpointsOfTheWatchdogOrNone) {
  EXPECT_NE(error_after("timeout_endpoint = 191", "").find("timeout_endpoint"), std::string::npos);
  EXPECT_NO_THROW(read_with(
      "[joint.can.watchdog]\nenabled_endpoint = 190         # check 1\ntimeout_endpoint = 191\n", ""));
}

}  // namespace
}  // namespace strainwave
