// SPDX-License-Identifier: BSD-3-Clause
// The notice that a joint has yielded to a load, and why, lasts until the joint moves again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kYieldsAt_rad = 0.5;
constexpr double kYieldsTo_Nm_rad = 2000.0;
constexpr double kRunsAt_rad_s = 1.0;
constexpr double kMayBear_Nm = 12.0;

BenchJoint joint_that_yields() {
  BenchJoint joint = demo_joint();
  joint.drive.plant.effects.contact = {
      kYieldsAt_rad, kYieldsTo_Nm_rad,
      0.2 * std::sqrt(kYieldsTo_Nm_rad * joint.drive.plant.joint.inertia_kgm2)};
  joint.loop.limits.load.load_Nm = kMayBear_Nm;
  joint.loop.limits.load.notice_Nm = 8.0;
  joint.loop.overload_stop = OverloadStop::kHoldLoad;
  return joint;
}

// A late observer still sees it, until the joint is moved again.
class YieldNotice : public ::testing::Test {
 protected:
  static constexpr Order kIntoTheWall{
      .kind = OrderKind::kSetpoint, .position_rad = 1.0, .speed_limit_rad_s = kRunsAt_rad_s};

  YieldNotice() { bench_.bring_to_hold(0); }
  bool told() { return bench_.has_notice(0, Notice::kYielded); }
  void run_into_the_wall(const Order& order = kIntoTheWall) {
    ASSERT_EQ(bench_.order(0, order), Reason::kAccepted);
    EXPECT_FALSE(told());
    ASSERT_GE(bench_.step_until([&] { return told(); }, 2000), 0);
  }

  JointBench bench_{{joint_that_yields()}};
};

TEST_F(YieldNotice, WithTheLoadWhatWasAllowedAndWhereItWas) {
  EXPECT_TRUE(std::isnan(bench_.state(0).yield_load_Nm));
  run_into_the_wall();
  const state_v1 began = bench_.state(0);
  EXPECT_GT(began.yield_load_Nm, kMayBear_Nm) << "the wall pushes towards where the joint came from";
  EXPECT_LT(began.yield_load_Nm, 45.0);
  EXPECT_EQ(began.yield_limit_Nm, kMayBear_Nm);
  EXPECT_EQ(began.yield_position_rad, began.joint_position_rad);
  EXPECT_NE(began.torque_feedback_Nm, 0.0);
  bench_.step();
  EXPECT_EQ(bench_.state(0).torque_feedback_Nm, 0.0) << "it yields from this period on";
  bench_.run(1.0);
  EXPECT_EQ(bench_.mode(0), Mode::kHolding);
  EXPECT_EQ(bench_.state(0).yield_load_Nm, began.yield_load_Nm) << "of then, not of now";
  EXPECT_EQ(bench_.state(0).yield_position_rad, began.yield_position_rad);
}

TEST_F(YieldNotice, OnceToTheLogWithTheModeThatItWasIn) {
  LoopEvent event;
  while (bench_.events().pop(event)) EXPECT_FALSE(event.yield);
  run_into_the_wall();
  bench_.run(1.0);
  int yields = 0;
  while (bench_.events().pop(event)) {
    if (!event.yield) continue;
    ++yields;
    EXPECT_EQ(event.from, Mode::kTracking);
    EXPECT_EQ(event.to, Mode::kTracking);
    EXPECT_EQ(event.yield->load_Nm, bench_.state(0).yield_load_Nm);
    EXPECT_EQ(event.yield->limit_Nm, kMayBear_Nm);
  }
  EXPECT_EQ(yields, 1);
}

TEST_F(YieldNotice, UntilTheNextMotionIsAccepted) {
  run_into_the_wall();
  EXPECT_EQ(bench_.move(0, 0.1), Reason::kMoving) << "it still yields";
  bench_.run(1.0);
  EXPECT_TRUE(told());
  EXPECT_EQ(bench_.order(0, OrderKind::kHold), Reason::kAccepted);
  bench_.run(0.1);
  EXPECT_TRUE(told()) << "a hold moves nothing";
  ASSERT_EQ(bench_.order(0, OrderKind::kDisable), Reason::kAccepted);
  bench_.run(1.0);
  EXPECT_TRUE(told());
  ASSERT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kAccepted);
  bench_.run(0.5);
  EXPECT_TRUE(told()) << "nor does enabling";
  ASSERT_EQ(bench_.move(0, 0.1), Reason::kAccepted);
  EXPECT_FALSE(told());
  EXPECT_TRUE(std::isnan(bench_.state(0).yield_load_Nm));
}

TEST_F(YieldNotice, UntilAPathBegins) {
  run_into_the_wall();
  bench_.run(1.0);
  const double here_rad = bench_.state(0).target_position_rad;
  KnotPath path;
  path.knots[path.count++] = {0.0, here_rad, 0.0};
  path.knots[path.count++] = {1.0, 0.1, 0.0};
  const auto slot = bench_.joint(0).joint().path_slots.hand_over({7, 1, path});
  ASSERT_EQ(bench_.order(0, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
            Reason::kAccepted);
  EXPECT_TRUE(told()) << "a part alone moves nothing";
  ASSERT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
  bench_.run(0.01);
  EXPECT_FALSE(told());
}

TEST(YieldNoticeInHoming, StandsUntilTheJointIsHomed) {
  BenchJoint joint = joint_that_yields();
  joint.drive.inputs = {-2.0, 2.0, -0.3, -0.2, 0.05, 0.125};
  joint.loop.homing.target = HomingTarget::kHomeSwitch;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.order(0, Order{.kind = OrderKind::kSetpoint,
                                 .position_rad = 2.0 * kYieldsAt_rad,
                                 .speed_limit_rad_s = kRunsAt_rad_s}),
            Reason::kAccepted);
  bench.run(2.0);
  EXPECT_TRUE(bench.has_notice(0, Notice::kYielded));
  ASSERT_EQ(bench.order(0, OrderKind::kHome), Reason::kAccepted);
  EXPECT_FALSE(bench.has_notice(0, Notice::kYielded));
}

TEST_F(YieldNotice, UntilTheFaultThatCameOfItIsCleared) {
  run_into_the_wall();
  bench_.joint(0).joint().raise_fault(Fault::kOverload, bench_.time());
  bench_.run(0.5);
  ASSERT_EQ(bench_.mode(0), Mode::kFaulted);
  EXPECT_TRUE(told());
  ASSERT_EQ(bench_.order(0, OrderKind::kClearFault), Reason::kAccepted);
  EXPECT_FALSE(told());
}

TEST_F(YieldNotice, ToTheStreamThatItEndedAndToNoOther) {
  Order sample = kIntoTheWall;
  sample.valid_for_s = 10.0;
  sample.stream_id = 1;
  sample.begins_stream = sample.approaches = true;
  sample.sent_us = bench_.sent_us();
  run_into_the_wall(sample);
  const auto refused = [&](std::int64_t stream_id) {
    sample.begins_stream = false;
    sample.stream_id = stream_id;
    EXPECT_EQ(bench_.order(0, sample), Reason::kStreamEnded);
    return bench_.last_reply();
  };
  EXPECT_EQ(refused(1).value, std::abs(bench_.state(0).yield_load_Nm));
  EXPECT_EQ(refused(1).limit, kMayBear_Nm);
  EXPECT_EQ(refused(2).limit, 0.0);
}

void yield_on_the_way(JointBench& bench, double speed_rad_s) {
  bench.bring_to_hold(0);
  ASSERT_EQ(
      bench.order(0, {.kind = OrderKind::kSetpoint, .position_rad = 1.0, .speed_limit_rad_s = speed_rad_s}),
      Reason::kAccepted);
  const auto yields = [&] {
    return bench.state(0).setpoint_velocity_rad_s == 0.0 && bench.has_notice(0, Notice::kYielded);
  };
  ASSERT_GE(bench.step_until(yields, 3000), 0);
}

TEST(YieldEnd, BrakesTheJointWithoutASurprise) {
  for (const double stiffness_Nm_rad : {200.0, 2000.0})
    for (const double speed_rad_s : {1.0, 2.0, 3.5}) {
      BenchJoint joint = joint_that_yields();
      joint.drive.plant.effects.contact.stiffness_Nm_rad = stiffness_Nm_rad;
      JointBench bench({joint});
      ASSERT_NO_FATAL_FAILURE(yield_on_the_way(bench, speed_rad_s));
      (void)bench.step_until([&] { return bench.state(0).setpoint_velocity_rad_s != 0.0; }, 1000);
      double largest_Nm = 0.0, farthest_rad_s = 0.0, last_rad = bench.state(0).joint_position_rad;
      for (int k = 0; k < 400; ++k) {
        bench.step();
        const state_v1 state = bench.state(0);
        largest_Nm = std::max(largest_Nm, std::abs(state.torque_commanded_Nm));
        farthest_rad_s = std::max(farthest_rad_s, std::abs(state.joint_velocity_rad_s -
                                                           1e3 * (state.joint_position_rad - last_rad)));
        last_rad = state.joint_position_rad;
      }
      EXPECT_EQ(bench.fault(0), Fault::kNone);
      EXPECT_LT(largest_Nm, 16.0) << "what decelerating takes is 13.4";
      EXPECT_LT(farthest_rad_s, 0.5);
    }
}

}  // namespace
}  // namespace strainwave::testing
