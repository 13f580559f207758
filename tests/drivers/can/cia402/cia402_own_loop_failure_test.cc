// SPDX-License-Identifier: BSD-3-Clause
// Failures of drives that close their own loop. Each drive stops on its ramp, and none jumps when it is enabled again.
#include "drivers/can/can_detail.h"
#include "tests/drivers/can/cia402/own_loop_drive.h"

namespace strainwave::testing {
namespace {

class Cia402OwnLoopFailure : public ::testing::TestWithParam<DriveMode> {
 protected:
  static constexpr double kSpeed_rad_s = 1.0;
  Cia402OwnLoopFailure() : drive_(own_loop(GetParam())) {}

  void start_turning() {
    joint_ = std::make_unique<OwnLoop>(drive_);
    (void)joint_->largest_error_rad(kSpeed_rad_s, 300);
    from_rad_ = joint_->position_rad();
    order_ = {0.0, true, from_rad_ + 2e-3, kSpeed_rad_s};
  }
  void expect_stop(ActuatorFault fault, CanDetail detail, int within_periods) {
    const int periods = joint_->bench.periods_until_fault(within_periods, order_);
    EXPECT_GT(periods, 0);
    EXPECT_EQ(joint_->bench.reading().fault, fault);
    EXPECT_EQ(detail_of(joint_->bench.reading().drive_error), detail);
    EXPECT_EQ(joint_->controlword(), 0x02U) << "quick stop";
    joint_->bench.run(500, order_);
    expect_rest(kSpeed_rad_s * (within_periods + 20) * 1e-3);
  }
  void expect_rest(double within_rad) {
    const can_nodes::ServoDrive& drive = joint_->bench.node().drive();
    EXPECT_NE(drive.power(), can_nodes::PowerState::kOperationEnabled);
    EXPECT_LT(std::abs(drive.plant().state().velocity_rad_s), 1e-3);
    EXPECT_LT(joint_->position_rad() - from_rad_, within_rad);
  }

  BenchDrive drive_;
  std::unique_ptr<OwnLoop> joint_;
  ActuatorCommand order_;
  double from_rad_ = 0.0;
};

TEST_P(Cia402OwnLoopFailure, ADriveThatLeavesItsModeIsStopped) {
  start_turning();
  joint_->bench.tell_node("pretend 0x6061 0 10");
  expect_stop(ActuatorFault::kWriteRefused, CanDetail::kWrongMode, 11);
}

TEST_P(Cia402OwnLoopFailure, PositionsThatStayLateAreAFaultAndStopTheDrive) {
  drive_.config.quick_stop_after = 20;  // otherwise the first gap would already be a fault
  start_turning();
  joint_->bench.tell_node("late-tpdo 2400 100000");
  expect_stop(ActuatorFault::kReadFailed, CanDetail::kPositionLate, 20);
}

TEST_P(Cia402OwnLoopFailure, ADriveThatLosesItsSupplyIsTakenUpWhereItIs) {
  start_turning();
  joint_->bench.tell_node("pretend 0x6041 0 0x0240");
  EXPECT_GT(joint_->bench.periods_until_fault(3, order_), 0);
  EXPECT_EQ(joint_->bench.reading().fault, ActuatorFault::kPowerLost);
  joint_->bench.run(500, order_);
  joint_->bench.tell_node("pretend nothing");
  joint_->bench.clear();
  const double rest_rad = joint_->position_rad();
  joint_->enable();
  for (int i = 0; i < 100; ++i) joint_->hold();
  EXPECT_NEAR(joint_->position_rad(), rest_rad, 2.0 * kOwnLoopCount_rad);
}

// The brake opens after power-on, and until then the drive does not follow the orders.
TEST_P(Cia402OwnLoopFailure, StandsUntilASlowBrakeIsOpen) {
  drive_.node.drive.enable_delay_us = 300'000;
  DriveBench bench({drive_});
  bench.start();
  const ActuatorCommand far{5.0, true, kOwnLoopInitial_rad + 0.5, kSpeed_rad_s};
  int periods = 0;
  while (bench.node().drive().power() != can_nodes::PowerState::kOperationEnabled && ++periods < 400)
    bench.step(far);
  EXPECT_GE(periods, 300);
  EXPECT_LT(periods, 400);
  bench.can().run_to(bench.can().now_ns() + DriveBench::kPeriod_ns / 2);
  EXPECT_NEAR(bench.node().drive().plant().state().position_rad, kOwnLoopInitial_rad, kOwnLoopCount_rad);
  EXPECT_LT(std::abs(bench.node().drive().plant().state().velocity_rad_s), 1e-3);
}

TEST_P(Cia402OwnLoopFailure, ADaemonThatHangsIsMissedByTheDeadlineOfItsOrders) {
  start_turning();
  joint_->bench.can().run_to(joint_->bench.can().now_ns() + 500 * DriveBench::kPeriod_ns);
  expect_rest(kSpeed_rad_s * (drive_.config.command_deadline_s + 0.02));
}

INSTANTIATE_TEST_SUITE_P(Modes, Cia402OwnLoopFailure,
                         ::testing::Values(DriveMode::kVelocity, DriveMode::kPosition),
                         [](const auto& mode) { return std::string(to_text(mode.param)); });

}  // namespace
}  // namespace strainwave::testing
