// SPDX-License-Identifier: BSD-3-Clause
// Several joints in one loop: effects of one joint's fault on the others. Virtual time.
#include <gtest/gtest.h>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

BenchJoint member(int group) {
  BenchJoint joint = demo_joint();
  joint.loop.group = group;
  return joint;
}

TEST(JointGroup, StopsInTheCycleInWhichOneOfItsJointsFaults) {
  JointBench bench({member(0), member(0), member(1), demo_joint()});
  for (std::size_t i = 0; i < 4; ++i) bench.bring_to_hold(i);
  for (std::size_t i = 0; i < 4; ++i) bench.move(i, 2.0);
  bench.run(0.1);
  bench.inject(0, {InjectedFault::kPowerLost});
  EXPECT_EQ(bench.joint(1).mode(), Mode::kFaulted);
  EXPECT_FALSE(bench.drive(1).command().enable);
  bench.step();
  EXPECT_EQ(bench.fault(0), Fault::kPowerLost);
  EXPECT_EQ(bench.fault(1), Fault::kGroup);
  bench.run(2.0);
  EXPECT_EQ(bench.mode(2), Mode::kHolding) << "another group goes on";
  EXPECT_NEAR(bench.state(2).joint_position_rad, 2.0, 1e-3);
  EXPECT_EQ(bench.mode(3), Mode::kHolding) << "a joint without a group goes on";
}

TEST(JointGroup, LeavesJointsAloneThatAreOff) {
  JointBench bench({member(0), member(0)});
  bench.bring_to_hold(0);
  bench.inject(0, {InjectedFault::kPowerLost});
  bench.run(0.1);
  EXPECT_EQ(bench.mode(1), Mode::kOff);
  EXPECT_EQ(bench.fault(1), Fault::kNone);
}

TEST(JointGroup, DoesNotFaultAgainWhenOneOfItsJointsIsClearedFirst) {
  JointBench bench({member(0), member(0)});
  for (std::size_t i = 0; i < 2; ++i) bench.bring_to_hold(i);
  bench.inject(0, {InjectedFault::kPowerLost, 0.0, 0.01, 0.0});
  bench.run(0.1);
  ASSERT_EQ(bench.fault(1), Fault::kGroup);
  ASSERT_EQ(bench.order(1, OrderKind::kClearFault), Reason::kAccepted);
  ASSERT_EQ(bench.order(1, OrderKind::kEnable), Reason::kAccepted);
  bench.run(0.5);
  EXPECT_EQ(bench.mode(1), Mode::kHolding) << "the old fault of the other joint is no new one";
  EXPECT_EQ(bench.mode(0), Mode::kFaulted);
}

}  // namespace
}  // namespace strainwave::testing
