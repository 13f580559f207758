// The ODrive driver against the independent simulated axis of tests/support/can_nodes, on a bus in virtual
// time.
#include "drivers/can/odrive/odrive_node.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/input_error.h"
#include "drivers/can/can_bus.h"
#include "drivers/can/can_detail.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/odrive_node.h"
#include "tests/support/virtual_can.h"

namespace strainwave::testing {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr ActuatorCommand kMoving{10.0, true};
constexpr ActuatorCommand kOff{0.0, false};

class OdriveDriver : public ::testing::Test {
 protected:
  OdriveDriver() {
    node_config_.node_id = 2;
    node_config_.plant = realistic_plant();
    node_config_.plant.delay.periods = 0.0;
    node_config_.encoder_us = 1000;
    node_config_.temperature_us = 100000;
    config_.name = "elbow";
    config_.node_id = 2;
    config_.units.encoder_turns_per_joint_turn = kReferenceGearRatio;
    config_.units.gear_ratio = kReferenceGearRatio;
    config_.torque_limit_Nm = 20.0;
    config_.watchdog = odrive::WatchdogEndpoints{190, 191};
  }

  void start() {
    axis_ = &can_.add<can_nodes::OdriveNode>(node_config_);
    can_.run_to(can_.now_ns() + 100 * kPeriod_ns);
    CanBusConfig bus;
    bus.interface_name = "can0";
    bus.sync = SyncProducer::kNone;
    bus.background_thread = false;
    std::vector<std::unique_ptr<CanNode>> nodes;
    nodes.push_back(std::make_unique<odrive::Node>(config_));
    bus_ = std::make_unique<CanBus>(bus, std::move(nodes), can_.factory());
    joint_ = bus_->make_actuator(0);
  }
  std::string refusal() {
    try {
      start();
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << "started";
    return "";
  }
  void step(const ActuatorCommand& command) {
    can_.run_to(can_.now_ns() + kPeriod_ns);
    bus_->begin_cycle(can_.now_ns());
    reading_ = joint_->read(can_.now_ns());
    joint_->write(command);
    bus_->end_cycle();
  }
  void run(int periods, const ActuatorCommand& command) {
    for (int i = 0; i < periods; ++i) step(command);
  }
  bool enable() {
    for (int i = 0; i < 400 && reading_.drive_state != DriveState::kEnabled; ++i) step({0.0, true});
    return reading_.drive_state == DriveState::kEnabled;
  }
  int periods_until_fault(int limit) {
    for (int i = 1; i <= limit; ++i) {
      step(kMoving);
      if (reading_.fault != ActuatorFault::kNone) return i;
    }
    return 0;
  }
  CanDetail detail() const { return detail_of(reading_.drive_error & ~odrive::kOurDetail); }
  void tell(const std::string& line) { EXPECT_EQ(axis_->command(line, can_.now_ns() / 1000), "") << line; }
  void start_moving() {
    start();
    ASSERT_TRUE(enable());
    run(50, kMoving);
    ASSERT_GT(axis_->plant().state().velocity_rad_s, 0.5);
  }

  can_nodes::OdriveNodeConfig node_config_;
  odrive::DriveConfig config_;
  VirtualCan can_;
  can_nodes::OdriveNode* axis_ = nullptr;
  std::unique_ptr<CanBus> bus_;
  std::unique_ptr<Actuator> joint_;
  ActuatorReading reading_;
};

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
  EXPECT_NE(refusal().find("does not tell its version"), std::string::npos);
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
  // Sampled within the last period, by an encoder of 320000 counts.
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

TEST_F(OdriveDriver, ReportsTheDrivesErrorsByName) {
  start_moving();
  tell("error 0x2000");
  EXPECT_NE(periods_until_fault(102), 0);  // the heartbeat tells it
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

TEST_F(OdriveDriver, SeesAnUnderVoltageAndAnEmergencyStopAsSuch) {
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

TEST_F(OdriveDriver, TakesTheTorqueAwayWhenPositionsAreMissingAndThenFails) {
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

TEST_F(OdriveDriver, TakesNoPositionThatIsNoNumber) {
  start_moving();
  tell("bad-encoder on");
  EXPECT_NE(periods_until_fault(20), 0);
  EXPECT_EQ(reading_.fault, ActuatorFault::kReadFailed);
  EXPECT_TRUE(std::isfinite(reading_.joint_position_rad));
}

TEST_F(OdriveDriver, LosesTheLinkWhenTheCableIsCutAndTheWatchdogStopsTheDrive) {
  start_moving();
  tell("cut");
  EXPECT_NE(periods_until_fault(20), 0);
  run(150, kMoving);
  EXPECT_EQ(axis_->errors(), can_nodes::kOdriveWatchdogExpired);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveDriver, IsSetUpAgainAfterALostLinkOnAnOperatorsOrderOnly) {
  start();
  run(100, kOff);
  tell("heartbeat off");
  run(400, {0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kLinkLost);
  EXPECT_EQ(detail(), CanDetail::kHeartbeatMissing);
  tell("heartbeat on");
  run(200, {0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kLinkLost) << "latched";
  run(10, kOff);
  tell("firmware 0 5 6");  // another drive was plugged in
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

TEST_F(OdriveDriver, SeesAnAxisThatNeverReachesClosedLoop) {
  start();
  tell("arming off");
  for (int i = 0; i < 1100 && reading_.fault == ActuatorFault::kNone; ++i) step({0.0, true});
  EXPECT_EQ(reading_.fault, ActuatorFault::kDriveFault);
  EXPECT_EQ(detail(), CanDetail::kEnableStep);
}

TEST_F(OdriveDriver, SeesADriveThatRestartedAndDoesNotEnableItByItself) {
  start_moving();
  tell("reboot 40");
  EXPECT_NE(periods_until_fault(200), 0);
  run(1000, kMoving);
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveDriver, RefusesATorqueThatIsNoNumber) {
  start_moving();
  step({std::numeric_limits<double>::quiet_NaN(), true});
  step(kMoving);
  EXPECT_EQ(reading_.fault, ActuatorFault::kWriteRefused);
  EXPECT_EQ(axis_->torque_Nm(), 0.0);
}

TEST_F(OdriveDriver, CountsFramesOfTheWrongSize) {
  start();
  run(10, kOff);
  CanFrame frame;
  frame.id = odrive::can_id(odrive::Command::kEstimates, 2);
  frame.size = 7;
  tell("skip-encoder 1");
  can_.send_as_stranger(frame);
  step(kOff);
  EXPECT_FALSE(reading_.has_position);
}

}  // namespace
}  // namespace strainwave::testing
