// SPDX-License-Identifier: BSD-3-Clause
// A loop that skips periods or stalls, while the joint moves on under the last torque. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr OverrunLimits kAnything{1e6, 1.0};

/// A joint that moves at a constant 2 rad/s.
class StalledLoop : public ::testing::Test {
 protected:
  void move(const OverrunLimits& limits) {
    BenchJoint joint = demo_joint();
    joint.loop.controller.motion.velocity_rad_s = 2.0;
    bench_ = std::make_unique<JointBench>(std::vector{joint}, limits);
    bench_->bring_to_hold(0);
    bench_->run(0.3);
    ASSERT_EQ(bench_->move(0, 3.0), Reason::kAccepted);
    bench_->run(0.6);
    ASSERT_NEAR(bench_->state(0).joint_velocity_rad_s, 2.0, 0.05);
  }
  const JointState& truth() { return bench_->drive(0).simulated().plant().state(); }
  std::unique_ptr<JointBench> bench_;
};

TEST_F(StalledLoop, DoesNotMistakeOneOrTwoSkippedPeriodsForAJumpOfTheJoint) {
  for (const int skipped : {1, 2, 5}) {
    move(kAnything);
    const double torque_Nm = bench_->state(0).torque_commanded_Nm;
    double setpoint_rad = bench_->state(0).setpoint_position_rad;
    bench_->stall(skipped);
    for (int i = 0; i < 100; ++i) {
      bench_->step();
      ASSERT_EQ(bench_->fault(0), Fault::kNone) << to_text(bench_->fault(0));
      EXPECT_NEAR(bench_->state(0).joint_velocity_rad_s, truth().velocity_rad_s, 0.1) << skipped << ", " << i;
      EXPECT_NEAR(bench_->state(0).torque_commanded_Nm, torque_Nm, 3.0) << skipped << ", " << i;
      EXPECT_GE(bench_->state(0).setpoint_position_rad, setpoint_rad) << "never backwards";
      setpoint_rad = bench_->state(0).setpoint_position_rad;
    }
    bench_->run(3.0);
    EXPECT_NEAR(bench_->state(0).joint_position_rad, 3.0, 1e-3) << skipped;
  }
}

TEST_F(StalledLoop, GoesOnAtTheSpeedThatItWasOrderedThroughSkippedPeriods) {
  move(kAnything);
  const double setpoint_rad = bench_->state(0).setpoint_position_rad;
  bench_->stall(3);
  bench_->step();
  EXPECT_NEAR(bench_->state(0).setpoint_position_rad - setpoint_rad, 4 * 0.002, 1e-9);
}

// The stall is longer than kMaxElapsedPeriods: the joint lags behind the stream, but the stream has not expired.
TEST_F(StalledLoop, GoesOnWithAStreamAtItsTimes) {
  constexpr int kAway = kMaxElapsedPeriods + 20;
  JointBench bench({demo_joint()}, kAnything);
  bench.bring_to_hold(0);
  for (int k = 0; k < 1000; ++k) {
    if (k % 10 == 0) {
      ASSERT_TRUE(bench.joint(0).orders().push(Order{.kind = OrderKind::kSetpoint,
                                                     .position_rad = 0.5e-3 * (k + 30),
                                                     .valid_for_s = 1.0,
                                                     .stream_id = 7,
                                                     .begins_stream = k == 0,
                                                     .velocity_rad_s = 0.5,
                                                     .derivatives = 1,
                                                     .at_cycle = bench.cycle() + 30}));
    }
    if (k == 400) {
      bench.stall(kAway);
      k += kAway;
    }
    bench.step();
  }
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 0.5e-3 * 999, 5e-3);
}

TEST_F(StalledLoop, IsAFaultAfterThreeSeconds) {
  move({});
  const double position_rad = truth().position_rad;
  bench_->stall(3000);
  bench_->step();
  EXPECT_EQ(bench_->fault(0), Fault::kLoopStalled);
  EXPECT_EQ(bench_->state(0).torque_commanded_Nm, 0.0);
  EXPECT_FALSE(bench_->drive(0).command().enable);
  EXPECT_GT(truth().position_rad, position_rad + 1.0) << "the joint has not waited for the loop";
}

TEST_F(StalledLoop, IsAFaultBeforeItHasBeenAwayForTwentyMillisecondsManyTimes) {
  // These limits allow each single stall.
  move({0.1, 0.1});
  int stalls = 0;
  for (; stalls < 232 && bench_->fault(0) == Fault::kNone; ++stalls) {
    bench_->stall(20);
    bench_->run(0.002);
  }
  EXPECT_EQ(bench_->fault(0), Fault::kPeriodsMissed);
  EXPECT_LE(stalls, 6);
}

/// A drive whose torque ends 5 ms after the last order, so that no model can predict a stall.
BenchJoint watched_joint(const MotionLimits& motion, double overspeed_rad_s) {
  BenchJoint joint = demo_joint();
  joint.drive.watchdog_s = 0.005;
  joint.loop.controller.motion = motion;
  joint.loop.limits.overspeed_rad_s = overspeed_rad_s;
  return joint;
}

/// Stalls the loop for `periods` at ten instants of a motion over the whole range. The joint must arrive without a fault.
void stall_anywhere(const BenchJoint& joint, const OverrunLimits& limits, int periods, double fastest_rad_s) {
  for (const double after_s : {0.02, 0.05, 0.13, 0.3, 0.7, 0.95, 1.2, 1.5, 1.57, 1.62}) {
    JointBench bench({joint}, limits);
    bench.bring_to_hold(0);
    ASSERT_EQ(bench.move(0, -3.0), Reason::kAccepted);
    bench.run(2.5);
    ASSERT_EQ(bench.move(0, 3.0), Reason::kAccepted);
    bench.run(after_s);
    bench.stall(periods);
    const JointState& truth = bench.drive(0).simulated().plant().state();
    double fastest_seen_rad_s = 0.0;
    double fastest_true_rad_s = 0.0;
    for (int i = 0; i < 3000; ++i) {
      bench.step();
      ASSERT_EQ(bench.fault(0), Fault::kNone)
          << to_text(bench.fault(0)) << ", " << i << " periods after a stall of " << periods << " at "
          << after_s << " s";
      fastest_seen_rad_s = std::max(fastest_seen_rad_s, std::abs(bench.state(0).joint_velocity_rad_s));
      fastest_true_rad_s = std::max(fastest_true_rad_s, std::abs(truth.velocity_rad_s));
    }
    EXPECT_LT(fastest_seen_rad_s, fastest_rad_s) << "seen, stall of " << periods << " at " << after_s << " s";
    EXPECT_LT(fastest_true_rad_s, fastest_rad_s) << "true, stall of " << periods << " at " << after_s << " s";
    EXPECT_NEAR(truth.position_rad, 3.0, 1e-3) << periods << ", " << after_s;
    EXPECT_EQ(bench.mode(0), Mode::kHolding) << periods << ", " << after_s;
  }
}

TEST(ToleratedStall, MakesNoOtherFaultWithWhatTheDemoTolerates) {
  for (const int periods : {1, 5, 9, 10, 19, 49, 50, 80, 300, 1990})
    stall_anywhere(watched_joint({4.0, 30.0, 30.0}, 8.0), {2.0, 1.0}, periods, 5.0);
}

TEST(ToleratedStall, MakesNoOtherFaultWithWhatIsToleratedByDefault) {
  for (const int periods : {1, 5, 9, 10, 15, 19})
    stall_anywhere(watched_joint({6.0, 150.0, 150.0}, 7.6), {}, periods, 7.5);
}

TEST_F(StalledLoop, IsNoFaultWhileAllJointsAreOff) {
  JointBench bench({demo_joint()});
  bench.stall(3000);
  bench.run(0.1);
  EXPECT_EQ(bench.mode(0), Mode::kOff);
}

}  // namespace
}  // namespace strainwave::testing
