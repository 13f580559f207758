// SPDX-License-Identifier: BSD-3-Clause
// The loop's handling of orders: streams that end, commands before their time, tables, restarts. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

class JointLoopOrders : public ::testing::Test {
 protected:
  JointLoopOrders() : bench_({demo_joint()}) {}
  const state_v1& state() const { return bench_.state(0); }
  JointBench bench_;
};

TEST_F(JointLoopOrders, EndAStreamThatStopsInABoundedDecelerationAndHold) {
  const double deceleration_rad_s2 = demo_joint().loop.controller.motion.deceleration_rad_s2;
  bench_.bring_to_hold(0);
  // Distant targets, so that the joint moves fast when the last one expires.
  ASSERT_EQ(bench_.move(0, 3.0, 0.1), Reason::kAccepted);
  ASSERT_EQ(bench_.step_until([&] { return bench_.has_notice(0, Notice::kSetpointExpired); }, 200), 100);
  double previous_rad_s = state().setpoint_velocity_rad_s;
  EXPECT_GT(previous_rad_s, 5.0);
  std::int64_t cycles = 0;
  for (; state().setpoint_velocity_rad_s != 0.0 && cycles < 1000; ++cycles) {
    bench_.step();
    EXPECT_LE(previous_rad_s - state().setpoint_velocity_rad_s, deceleration_rad_s2 * 0.001 * (1.0 + 1e-9));
    EXPECT_LE(state().setpoint_velocity_rad_s, previous_rad_s);
    previous_rad_s = state().setpoint_velocity_rad_s;
  }
  EXPECT_LE(cycles, 6.0 / deceleration_rad_s2 / 0.001 + 3.0) << "no longer than the deceleration takes";
  bench_.run(1.0);
  EXPECT_EQ(bench_.mode(0), Mode::kHolding);
  EXPECT_EQ(bench_.fault(0), Fault::kNone);
  EXPECT_LT(state().joint_position_rad, 1.5) << "it did not go on to the target";
}

// The stream is the former owner's, with samples that are still in the future.
TEST_F(JointLoopOrders, ThatTakeAJointOverEndAStreamAndLeaveAMove) {
  bench_.bring_to_hold(0);
  for (int sample = 0; sample < 8; ++sample)
    ASSERT_EQ(bench_.order(0, Order{.kind = OrderKind::kSetpoint,
                                    .position_rad = 0.1 * sample,
                                    .valid_for_s = 2.0,
                                    .stream_id = 1,
                                    .begins_stream = sample == 0,
                                    .at_cycle = bench_.cycle() + 50 + 100 * sample}),
              Reason::kAccepted);
  bench_.run(0.2);
  ASSERT_EQ(bench_.order(0, OrderKind::kEndStream), Reason::kAccepted);
  bench_.run(0.2);
  EXPECT_EQ(bench_.mode(0), Mode::kHolding);
  EXPECT_LT(state().joint_position_rad, 0.3);
  ASSERT_EQ(bench_.move(0, 0.6), Reason::kAccepted);
  bench_.run(0.05);
  ASSERT_EQ(bench_.order(0, OrderKind::kEndStream), Reason::kAccepted);
  bench_.run(1.5);
  EXPECT_NEAR(state().joint_position_rad, 0.6, 1e-3);
}

TEST_F(JointLoopOrders, OfAStreamThatAFaultOrADisableEndedMoveNothingAfterAnEnable) {
  for (const bool by_fault : {true, false}) {
    SCOPED_TRACE(by_fault);
    bench_.bring_to_hold(0);
    ASSERT_EQ(bench_.move(0, 0.5, 10.0), Reason::kAccepted);
    bench_.run(0.02);
    if (by_fault) {
      bench_.joint(0).joint().raise_fault(Fault::kEmergencyStop, bench_.time());
      bench_.run(1.0);
      ASSERT_EQ(bench_.order(0, OrderKind::kClearFault), Reason::kAccepted);
    } else {
      ASSERT_EQ(bench_.order(0, OrderKind::kDisable), Reason::kAccepted);
      ASSERT_GE(bench_.step_until([&] { return bench_.mode(0) == Mode::kOff; }, 3000), 0);
    }
    bench_.run(0.5);
    ASSERT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kAccepted);
    bench_.run(1.0);
    ASSERT_EQ(bench_.mode(0), Mode::kHolding);
    const double held_rad = state().joint_position_rad;
    EXPECT_EQ(bench_.move(0, 2.0, 10.0, false), Reason::kStreamEnded);
    bench_.run(0.5);
    EXPECT_NEAR(state().joint_position_rad, held_rad, 1e-4);
    ASSERT_EQ(bench_.order(0, OrderKind::kDisable), Reason::kAccepted);
    bench_.run(1.0);
  }
}

TEST_F(JointLoopOrders, ThatWaitedBeyondTheirTimeAreRefused) {
  bench_.bring_to_hold(0);
  Order late;
  late.kind = OrderKind::kSetpoint;
  late.position_rad = 0.5;
  late.expires_cycle = bench_.cycle();
  EXPECT_EQ(bench_.order(0, late), Reason::kTooOld);
  late.expires_cycle = bench_.cycle() + 10;
  EXPECT_EQ(bench_.order(0, late), Reason::kAccepted);
}

// Only a client that has seen a fault may clear it. An order that was sent before the fault does not refer to it.
TEST_F(JointLoopOrders, ThatWaitedWhileTheJointFaultedAreRefused) {
  bench_.bring_to_hold(0);
  Order order;
  order.kind = OrderKind::kClearFault;
  order.challenge_cycle = bench_.cycle();
  bench_.joint(0).joint().raise_fault(Fault::kGroup, bench_.time());
  const std::int64_t faulted_cycle = bench_.cycle();
  for (const std::int64_t challenge_cycle : {faulted_cycle - 1, faulted_cycle}) {
    order.challenge_cycle = challenge_cycle;
    EXPECT_EQ(bench_.order(0, order), Reason::kTooOld) << challenge_cycle - faulted_cycle;
    EXPECT_EQ(bench_.mode(0), Mode::kFaulted);
  }
  order.challenge_cycle = faulted_cycle + 1;
  EXPECT_EQ(bench_.order(0, order), Reason::kAccepted);
  order.kind = OrderKind::kEnable;
  order.challenge_cycle = faulted_cycle;
  EXPECT_EQ(bench_.order(0, order), Reason::kTooOld) << "the fault is cleared: the enable is from before it";
  EXPECT_EQ(bench_.mode(0), Mode::kOff);
  order.kind = OrderKind::kDisable;
  order.challenge_cycle = -1;
  EXPECT_NE(bench_.order(0, order), Reason::kTooOld);
}

TEST_F(JointLoopOrders, AreRefusedBeforeTheirTime) {
  EXPECT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kNoTable);
  EXPECT_EQ(bench_.move(0, 0.5), Reason::kWrongMode);
  EXPECT_EQ(bench_.order(0, OrderKind::kHold), Reason::kWrongMode);
  EXPECT_EQ(bench_.order(0, OrderKind::kClearFault), Reason::kWrongMode);
  bench_.joint(0).table_slot(0) = {demo_table(), 1};
  ASSERT_EQ(bench_.order(0, OrderKind::kUseTable), Reason::kAccepted);
  EXPECT_EQ(bench_.move(0, 0.5), Reason::kWrongMode);
  ASSERT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kAccepted);
  EXPECT_EQ(bench_.mode(0), Mode::kStarting);
  EXPECT_EQ(bench_.move(0, 0.5), Reason::kWrongMode) << "the drive is not ready yet";
  bench_.run(0.5);
  EXPECT_EQ(bench_.mode(0), Mode::kHolding);
  EXPECT_EQ(state().target_position_rad, state().setpoint_position_rad) << "what was refused is forgotten";
}

TEST_F(JointLoopOrders, ShowNoticesWithTheLimitsInForce) {
  bench_.bring_to_hold(0);
  ASSERT_EQ(bench_.move(0, 3.0), Reason::kAccepted);
  EXPECT_GE(bench_.step_until([&] { return bench_.has_notice(0, Notice::kSpeedLimited); }, 1000), 0);
  bench_.run(2.0);
  EXPECT_FALSE(bench_.has_notice(0, Notice::kSpeedLimited));
}

TEST(JointLoopMoves, GoAtTheCalmShareOfTheSpeedLimitUnlessThatOrderNamesASpeed) {
  BenchJoint joint = demo_joint();
  joint.loop.move_speed_share = 0.25;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  double target_rad = 1.5;
  for (const double named_rad_s : {5.0, 0.0, 0.5}) {
    ASSERT_EQ(bench.order(0, Order{.kind = OrderKind::kSetpoint,
                                   .position_rad = target_rad,
                                   .speed_limit_rad_s = named_rad_s}),
              Reason::kAccepted);
    double fastest_rad_s = 0.0;
    for (int k = 0; k < 2500; ++k) {
      bench.step();
      fastest_rad_s = std::max(fastest_rad_s, std::abs(bench.state(0).setpoint_velocity_rad_s));
    }
    EXPECT_NEAR(fastest_rad_s, named_rad_s == 0.0 ? 0.25 * 6.0 : named_rad_s, 1e-9);
    target_rad -= 0.75;
  }
}

TEST(JointLoopNotices, TellOfATemperatureOutsideTheTable) {
  BenchJoint joint = demo_joint();
  joint.drive.ambient = TemperatureProfile::constant(60.0);
  JointBench bench({joint});
  bench.bring_to_hold(0);
  bench.run(0.1);
  EXPECT_TRUE(bench.has_notice(0, Notice::kTemperatureClamped));
}

// Learning is frozen; otherwise it would learn the load.
TEST(JointLoopNotices, TellOfALoadThatHoldsTheJointOffItsPlaceForASecond) {
  JointBench bench({demo_joint()});
  ASSERT_EQ(bench.order(0, OrderKind::kFreezeLearning), Reason::kAccepted);
  bench.bring_to_hold(0);
  bench.drive(0).simulated().set_load_torque_Nm(10.0);
  EXPECT_GE(bench.step_until([&] { return bench.has_notice(0, Notice::kOffTarget); }, 3000), 1000);
  EXPECT_EQ(bench.mode(0), Mode::kHolding);
}

TEST(JointLoopNotices, TellOfATorqueLimit) {
  BenchJoint joint = demo_joint();
  joint.loop.controller.torque_limit_Nm = 3.0;
  joint.loop.limits.following_error_rad = 10.0;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  bench.drive(0).simulated().set_load_torque_Nm(6.0);
  EXPECT_GE(bench.step_until([&] { return bench.has_notice(0, Notice::kTorqueLimited); }, 3000), 0);
}

}  // namespace
}  // namespace strainwave::testing
