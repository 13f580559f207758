// SPDX-License-Identifier: BSD-3-Clause
// Conditions for the start of a motion: a joint at rest that is not too hot, and orders that are numbers.
#include <gtest/gtest.h>

#include "tests/daemon/realtime/joint/scripted_joint.h"

namespace strainwave::testing {
namespace {

using JointLoopStart = ScriptedJoint;

TEST_F(JointLoopStart, LatchTheTemperatureLimitInOneCycleWhateverThePlausibility) {
  // Within the sensor's range but too sudden, just above the range, and far above it.
  for (const double temperature_C : {85.0, 90.5, 200.0}) {
    drive_->reading.drive_state = DriveState::kDisabled;
    drive_->reading.temperature_C = 25.0;
    hold();
    drive_->reading.temperature_C = temperature_C;
    EXPECT_EQ(cycles_until_fault(1), 1) << temperature_C;
    EXPECT_EQ(fault(), Fault::kTemperatureLimit) << temperature_C;
    drive_->reading.drive_state = DriveState::kDisabled;
    ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
  }
}

TEST_F(JointLoopStart, NeverLetATooHotJointBeControlled) {
  drive_->reading.temperature_C = 95.0;
  step();
  order(OrderKind::kEnable);
  EXPECT_EQ(loop_->mode(), Mode::kFaulted);
  EXPECT_EQ(fault(), Fault::kTemperatureLimit);
  EXPECT_FALSE(drive_->last.enable);
}

TEST_F(JointLoopStart, MakeALossOfTemperatureAFaultWhereThatIsConfigured) {
  for (const bool loss_is_fault : {false, true}) {
    config_.temperature.loss_is_fault = loss_is_fault;
    config_.temperature.max_age_s = 0.1;
    make();
    hold();
    drive_->reading.has_temperature = false;
    const int cycles = cycles_until_fault(1000);
    if (loss_is_fault) {
      EXPECT_NEAR(cycles, 100, 2);
      EXPECT_EQ(fault(), Fault::kTemperatureLost);
    } else {
      EXPECT_EQ(cycles, 0);
      EXPECT_EQ(loop_->record().state.temperature_status, static_cast<int>(TemperatureStatus::kTooOld));
    }
  }
}

TEST_F(JointLoopStart, RefuseToEnableAJointThatMovesAndSayHowFast) {
  drive_->drifting_rad_s = 3.6;
  for (int i = 0; i < 200; ++i) step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kMoving);
  EXPECT_NEAR(bench_->last_reply().value, 3.6, 1e-3);
  EXPECT_EQ(bench_->last_reply().limit, config_.standstill_rad_s);
  EXPECT_EQ(loop_->mode(), Mode::kOff);
  EXPECT_FALSE(drive_->last.enable);
  drive_->drifting_rad_s = 0.0;
  stand();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
}

TEST_F(JointLoopStart, BeginWithTheMotionThatTheJointHasWhenItsDriveBecomesReady) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drive_->drifting_rad_s = 0.5;  // an external push while the drive starts
  for (int i = 0; i < 90; ++i) step();
  drive_->reading.drive_state = DriveState::kEnabled;
  step();
  ASSERT_EQ(loop_->mode(), Mode::kHolding);
  const state_v1& first = loop_->record().state;
  EXPECT_NEAR(first.setpoint_velocity_rad_s, 0.5, 0.2) << "it comes to rest from there";
  EXPECT_NEAR(first.setpoint_position_rad, first.joint_position_rad, 1e-3);
}

TEST_F(JointLoopStart, ShowTheControllersOwnSetpointFromTheFirstRecordOn) {
  drive_->reading.joint_position_rad = 1.25;
  stand();
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drive_->reading.drive_state = DriveState::kEnabled;
  for (int i = 0; i < 5; ++i) {
    step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding);
    EXPECT_DOUBLE_EQ(loop_->record().state.setpoint_position_rad, 1.25) << i;
    EXPECT_DOUBLE_EQ(loop_->record().state.target_position_rad, 1.25) << i;
  }
}

TEST_F(JointLoopStart, RefuseEveryOrderThatCouldMoveAJointWhileTheDaemonEnds) {
  hold();
  loop_->end(bench_->time());
  EXPECT_EQ(loop_->mode(), Mode::kStopping);
  EXPECT_EQ(order(OrderKind::kSetpoint), Reason::kEnding);
  EXPECT_EQ(order(OrderKind::kHome), Reason::kEnding);
  for (int i = 0; i < 100 && loop_->mode() != Mode::kOff; ++i) step();
  ASSERT_EQ(loop_->mode(), Mode::kOff);
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kEnding);
  EXPECT_EQ(loop_->mode(), Mode::kOff);
}

}  // namespace
}  // namespace strainwave::testing
