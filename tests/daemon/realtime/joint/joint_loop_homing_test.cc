// SPDX-License-Identifier: BSD-3-Clause
// Homing and limit switches of a complete joint with control law, friction and encoder.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// Limits at -1 and 1, home switch from 0.2 to 0.3. The joint is at 0.7, where its encoder begins to count.
BenchJoint joint_to_be_homed() {
  BenchJoint joint = demo_joint();
  joint.drive.plant.initial_position_rad = 0.7;
  joint.drive.incremental = true;
  joint.drive.inputs = {-1.0, 1.0, 0.2, 0.3, 0.05, 0.125};
  joint.loop.limits.position_min_rad = -0.9;
  joint.loop.limits.position_max_rad = 0.9;
  HomingConfig& homing = joint.loop.homing;
  homing.target = HomingTarget::kHomeSwitch;
  homing.required = true;
  homing.home_position_rad = 0.3;
  homing.speed_rad_s = 0.1;
  homing.travel_rad = 2.0;
  return joint;
}

class JointLoopHoming : public ::testing::Test {
 protected:
  double truth_rad() { return bench_->drive(0).simulated().plant().state().position_rad; }
  void hold(const BenchJoint& joint) {
    bench_ = std::make_unique<JointBench>(std::vector{joint});
    bench_->bring_to_hold(0);
  }
  bool home() {
    EXPECT_EQ(bench_->order(0, OrderKind::kHome), Reason::kAccepted);
    return bench_->step_until([&] { return bench_->mode(0) != Mode::kHoming; }, 60'000) > 0 &&
           bench_->mode(0) == Mode::kHolding;
  }
  bool arrive() {
    return bench_->step_until([&] { return bench_->mode(0) != Mode::kTracking; }, 10'000) > 0 &&
           bench_->mode(0) == Mode::kHolding;
  }
  std::unique_ptr<JointBench> bench_;
};

TEST_F(JointLoopHoming, MakesPositionsTrueWithoutAJump) {
  hold(joint_to_be_homed());
  EXPECT_NEAR(bench_->state(0).joint_position_rad, 0.0, 1e-3) << "counted from the start";
  ASSERT_TRUE(home());
  EXPECT_NEAR(bench_->state(0).joint_position_rad, truth_rad(), 1e-4);
  EXPECT_FALSE(bench_->has_notice(0, Notice::kNotHomed));
  const double position_rad = truth_rad();
  // A reversing push at the end of the motion costs 7.7 N.m. A position that jumped by the new zero would cost the full limit of 34.
  for (int period = 0; period < 500; ++period) {
    const double torque_Nm = bench_->state(0).torque_commanded_Nm;
    bench_->step();
    ASSERT_NEAR(bench_->state(0).torque_commanded_Nm, torque_Nm, 9.0) << period;
  }
  EXPECT_NEAR(truth_rad(), position_rad, 1e-4);
  ASSERT_EQ(bench_->move(0, -0.5), Reason::kAccepted);
  ASSERT_TRUE(arrive());
  bench_->run(1.0);
  EXPECT_NEAR(truth_rad(), -0.5, 1e-3);
  EXPECT_EQ(bench_->state(0).target_position_rad, -0.5) << "clients compare it with what they ordered";
}

TEST_F(JointLoopHoming, IsNeverFasterThanItsSpeed) {
  hold(joint_to_be_homed());
  ASSERT_EQ(bench_->order(0, OrderKind::kHome), Reason::kAccepted);
  double fastest_rad_s = 0.0;
  while (bench_->mode(0) == Mode::kHoming) {
    fastest_rad_s =
        std::max(fastest_rad_s, std::abs(bench_->drive(0).simulated().plant().state().velocity_rad_s));
    bench_->step();
  }
  EXPECT_LT(fastest_rad_s, 0.11);
  EXPECT_GT(fastest_rad_s, 0.09);
  ASSERT_EQ(bench_->move(0, -0.8), Reason::kAccepted);
  fastest_rad_s = 0.0;
  while (bench_->mode(0) == Mode::kTracking) {
    fastest_rad_s =
        std::max(fastest_rad_s, std::abs(bench_->drive(0).simulated().plant().state().velocity_rad_s));
    bench_->step();
  }
  EXPECT_GT(fastest_rad_s, 2.0) << "the speed limit is the joint's own again";
}

TEST_F(JointLoopHoming, MustComeBeforeAnySetpointWhereRequired) {
  hold(joint_to_be_homed());
  EXPECT_TRUE(bench_->has_notice(0, Notice::kNotHomed));
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kNotHomed);
  EXPECT_EQ(bench_->move(0, 0.1, 0.5), Reason::kNotHomed) << "a stream neither";
  EXPECT_EQ(bench_->mode(0), Mode::kHolding);
  ASSERT_TRUE(home());
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kAccepted);
}

TEST_F(JointLoopHoming, RefusesSetpointsWhileItLastsAndEndsWithAHold) {
  hold(joint_to_be_homed());
  ASSERT_EQ(bench_->order(0, OrderKind::kHome), Reason::kAccepted);
  bench_->run(0.3);
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kNotHomed);
  EXPECT_EQ(bench_->order(0, OrderKind::kHome), Reason::kWrongMode);
  ASSERT_EQ(bench_->order(0, OrderKind::kHold), Reason::kAccepted);
  ASSERT_GT(bench_->step_until([&] { return bench_->mode(0) == Mode::kHolding; }, 1000), 0);
  EXPECT_TRUE(bench_->has_notice(0, Notice::kNotHomed));
  const double position_rad = truth_rad();
  bench_->run(1.0);
  EXPECT_NEAR(truth_rad(), position_rad, 1e-3) << "it does not go on";
  EXPECT_TRUE(home()) << "but can begin anew";
}

TEST_F(JointLoopHoming, ThatFindsNothingIsAFaultAndThePositionStaysUnknown) {
  BenchJoint joint = joint_to_be_homed();
  joint.loop.homing.travel_rad = 0.2;
  hold(joint);
  EXPECT_FALSE(home());
  EXPECT_EQ(bench_->fault(0), Fault::kHomingFailed);
  EXPECT_GT(truth_rad(), 0.49);
  ASSERT_EQ(bench_->order(0, OrderKind::kClearFault), Reason::kAccepted);
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kNotHomed);
}

TEST_F(JointLoopHoming, IsForgottenWhenCountsMayHaveBeenLost) {
  hold(joint_to_be_homed());
  ASSERT_TRUE(home());
  ASSERT_EQ(bench_->inject(0, {InjectedFault::kSensorNan, 0.0, 0.01, 0.0}), Reason::kAccepted);
  ASSERT_EQ(bench_->fault(0), Fault::kImplausibleReading);
  bench_->run(0.1);
  EXPECT_TRUE(bench_->has_notice(0, Notice::kNotHomed));
  ASSERT_EQ(bench_->order(0, OrderKind::kClearFault), Reason::kAccepted);
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kNotHomed);
}

TEST_F(JointLoopHoming, SurvivesADisable) {
  hold(joint_to_be_homed());
  ASSERT_TRUE(home());
  ASSERT_EQ(bench_->order(0, OrderKind::kDisable), Reason::kAccepted);
  ASSERT_GE(bench_->step_until([&] { return bench_->mode(0) == Mode::kOff; }, 2000), 0);
  bench_->bring_to_hold(0);
  EXPECT_EQ(bench_->move(0, 0.1), Reason::kAccepted);
}

/// A joint without homing. The positive limit switch is inside the position limits.
BenchJoint joint_with_switch_in_its_way() {
  BenchJoint joint = demo_joint();
  joint.drive.inputs.positive_limit_rad = 0.5;
  return joint;
}

TEST_F(JointLoopHoming, StopsAMotionIntoALimitSwitchAsAFault) {
  hold(joint_with_switch_in_its_way());
  ASSERT_EQ(bench_->move(0, 0.8), Reason::kAccepted);
  ASSERT_GT(bench_->step_until([&] { return bench_->mode(0) == Mode::kFaulted; }, 5000), 0);
  EXPECT_EQ(bench_->fault(0), Fault::kLimitSwitch);
  EXPECT_FALSE(bench_->drive(0).command().enable);
  EXPECT_EQ(bench_->drive(0).command().torque_Nm, 0.0);
}

TEST_F(JointLoopHoming, LeavesALimitSwitchOnlyTheWayItCame) {
  BenchJoint joint = joint_with_switch_in_its_way();
  joint.drive.plant.initial_position_rad = 0.52;
  hold(joint);
  EXPECT_TRUE(bench_->has_notice(0, Notice::kAtLimitSwitch));
  EXPECT_EQ(bench_->move(0, 0.6), Reason::kAtLimitSwitch);
  EXPECT_EQ(bench_->mode(0), Mode::kHolding);
  ASSERT_EQ(bench_->move(0, 0.4), Reason::kAccepted);
  ASSERT_TRUE(arrive());
  EXPECT_FALSE(bench_->has_notice(0, Notice::kAtLimitSwitch));
  EXPECT_NEAR(truth_rad(), 0.4, 1e-3);
}

TEST_F(JointLoopHoming, GivesNoTorqueIntoALimitSwitch) {
  BenchJoint joint = joint_with_switch_in_its_way();
  joint.drive.plant.initial_position_rad = 0.52;
  hold(joint);
  // The load pulls away from the switch, so that holding it would need positive torque.
  bench_->drive(0).simulated().set_load_torque_Nm(12.0);
  for (int i = 0; i < 2000 && bench_->has_notice(0, Notice::kAtLimitSwitch); ++i) {
    EXPECT_LE(bench_->drive(0).command().torque_Nm, 0.0);
    bench_->step();
  }
}

}  // namespace
}  // namespace strainwave::testing
