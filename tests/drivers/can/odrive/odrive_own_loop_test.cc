// SPDX-License-Identifier: BSD-3-Clause
// An ODrive that closes its own position or velocity loop: the orders to it, and how it stops.
#include <bit>
#include <cmath>
#include <limits>

#include "drivers/can/odrive/odrive_order.h"
#include "tests/drivers/can/odrive/odrive_driver.h"

namespace strainwave::testing {
namespace {

class OdriveOwnLoop : public OdriveDriver {
 protected:
  static constexpr double kInitial_rad = 0.4;
  static constexpr double kPeriod_s = 1e-3;

  OdriveOwnLoop() {
    config_.drive_mode = DriveMode::kPosition;
    node_config_.torques_us = 1000;
    node_config_.plant.period_s = kPeriod_s / 8.0;  // a typical ratio for such drives
    node_config_.plant.initial_position_rad = kInitial_rad;
  }
  void start_enabled() {
    start();
    ASSERT_TRUE(enable());
    // The joint loop gives this order while a joint is not controlled.
    order_ = {0.0, true, reading_.joint_position_rad, 0.0};
  }
  /// Turns the joint. Returns the largest distance of the reading to the position due at that instant, in the second half.
  double largest_error_rad(double velocity_rad_s, int periods) {
    double largest_rad = 0.0;
    order_.motor_velocity_rad_s = velocity_rad_s;
    for (int i = 0; i < periods; ++i) {
      const double due_rad = order_.motor_position_rad;
      order_.motor_position_rad += velocity_rad_s * kPeriod_s;
      step(order_);
      if (i > periods / 2)
        largest_rad = std::max(largest_rad, std::abs(reading_.joint_position_rad - due_rad));
    }
    return largest_rad;
  }
  void expect_to_coast_to_rest() {
    EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
    EXPECT_EQ(axis_->torque_Nm(), 0.0);
    run(3000, order_);
    EXPECT_TRUE(joint().stuck);
  }
  const JointState& joint() const { return axis_->plant().state(); }

  ActuatorCommand order_;
};

class OdriveOwnLoopDirection : public OdriveOwnLoop, public ::testing::WithParamInterface<int> {
 protected:
  OdriveOwnLoopDirection() {
    config_.units.direction = GetParam();
    config_.units.position_offset_rad = 0.1;
    node_config_.joint_turns_per_encoder_turn *= GetParam();
    node_config_.joint_torque_per_drive_torque *= GetParam();
  }
};

TEST_P(OdriveOwnLoopDirection, StandsWhereItIsWhileItIsEnabled) {
  start_enabled();
  run(100, order_);
  EXPECT_NEAR(joint().position_rad, kInitial_rad, 1e-4);
  EXPECT_NEAR(reading_.joint_position_rad, kInitial_rad + 0.1, 1e-4);
}

TEST_P(OdriveOwnLoopDirection, ArrivesAtTheEndOfTheOrdersPeriodAndSaysItsTorque) {
  start_enabled();
  EXPECT_LT(largest_error_rad(1.0, 1500), 0.3 * kPeriod_s)
      << "with the place of the period's end it is half a period early";
  EXPECT_TRUE(reading_.torque_measured);
  EXPECT_GT(reading_.torque_applied_Nm, 1.0) << "friction";
}

TEST_P(OdriveOwnLoopDirection, TurnsAtTheVelocityThatItIsOrdered) {
  config_.drive_mode = DriveMode::kVelocity;
  start_enabled();
  run(500, {0.0, true, 0.0, -0.8});
  EXPECT_NEAR(joint().velocity_rad_s, -0.8, 0.02);
  EXPECT_LT(reading_.torque_applied_Nm, -1.0);
}

INSTANTIATE_TEST_SUITE_P(Signs, OdriveOwnLoopDirection, ::testing::Values(1, -1));

TEST_F(OdriveOwnLoop, TakesTheTorqueThatIsFedForwardWithinTheLimit) {
  node_config_.velocity_bandwidth_rad_s = 1e-6;  // disables the drive's own loop
  start_enabled();
  order_.torque_Nm = 5.0;
  run(2, order_);
  EXPECT_NEAR(axis_->torque_Nm(), 5.0, 0.5 * 50.0 / odrive::kTorqueUnitsPerNm);
  config_.torque_limit_Nm = 4.0;
  const CanFrame by_position = odrive::order_frame(config_, order_);
  EXPECT_EQ(little_endian(&by_position.bytes[6], 2), 80U) << "thousandths of a N m at the motor";
  config_.drive_mode = DriveMode::kVelocity;
  const CanFrame by_velocity = odrive::order_frame(config_, order_);
  EXPECT_EQ(std::bit_cast<float>(static_cast<std::uint32_t>(little_endian(&by_velocity.bytes[4], 4))), 0.08F);
}

TEST_F(OdriveOwnLoop, SendsTheVelocityInTheUnitOfTheDrivesSetting) {
  for (const double scale : {1000.0, 100.0}) {
    config_.units.velocity_units_per_turn_s = scale;
    const CanFrame frame = odrive::order_frame(config_, {0.0, true, 0.0, 2.0});
    EXPECT_NEAR(static_cast<double>(little_endian(&frame.bytes[4], 2)), 2.0 * 50.0 / (2.0 * M_PI) * scale,
                0.5)
        << scale;
  }
  const CanFrame frame = odrive::order_frame(config_, {0.0, true, 0.0, 1e6});
  EXPECT_EQ(little_endian(&frame.bytes[4], 2), 32767U) << "it does not wrap";
}

TEST_F(OdriveOwnLoop, NeedsTheDrivesTorqueEachPeriod) {
  node_config_.torques_us = 10000;
  EXPECT_NE(refusal().find("axis0.config.can.torques_msg_rate_ms: 50 torque messages"), std::string::npos);
}

TEST_F(OdriveOwnLoop, GoesOnWithThePlanWhilePositionsStayAwayAndThenStops) {
  start_enabled();
  (void)largest_error_rad(1.0, 300);
  tell("skip-encoder 1000");
  (void)largest_error_rad(1.0, config_.fault_after);
  EXPECT_EQ(reading_.fault, ActuatorFault::kNone);
  EXPECT_NEAR(joint().position_rad, order_.motor_position_rad, 2.0 * kPeriod_s)
      << "no count is needed to follow";
  run(2, order_);
  EXPECT_EQ(reading_.fault, ActuatorFault::kReadFailed);
  run(2, order_);
  expect_to_coast_to_rest();
}

TEST_F(OdriveOwnLoop, DisarmsAtOnceThoughItWasJustArmedAndNoTorqueIsFedForward) {
  node_config_.heartbeat_us = 10000;
  start_enabled();
  (void)largest_error_rad(1.0, 20);
  joint_->stop();
  run(2, order_);
  expect_to_coast_to_rest();
}

TEST_F(OdriveOwnLoop, EndsWithItsWatchdogWhenTheOrdersEnd) {
  start_enabled();
  (void)largest_error_rad(1.0, 300);
  can_.run_to(can_.now_ns() + 99 * kPeriod_ns);
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kClosedLoop);
  can_.run_to(can_.now_ns() + 2 * kPeriod_ns);
  EXPECT_EQ(axis_->errors(), can_nodes::kOdriveWatchdogExpired);
  run(101, order_);
  EXPECT_EQ(reading_.fault, ActuatorFault::kDriveFault);
  expect_to_coast_to_rest();
}

TEST_F(OdriveOwnLoop, DoesNotJumpWhenItIsEnabledAnewElsewhere) {
  start_enabled();
  (void)largest_error_rad(1.0, 500);
  run(300, {});
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kIdle);
  const double there_rad = joint().position_rad;
  ASSERT_GT(there_rad, kInitial_rad + 0.3);
  reading_ = {};
  for (int i = 0; i < 50; ++i) step({0.0, true, reading_.joint_position_rad, 0.0});
  EXPECT_EQ(axis_->state(), can_nodes::OdriveState::kClosedLoop);
  EXPECT_NEAR(joint().position_rad, there_rad, 1e-4);
}

TEST_F(OdriveOwnLoop, RefusesAnOrderThatIsNoNumber) {
  start_enabled();
  step({0.0, true, std::numeric_limits<double>::quiet_NaN(), 0.0});
  step(order_);
  EXPECT_EQ(reading_.fault, ActuatorFault::kWriteRefused);
}

}  // namespace
}  // namespace strainwave::testing
