// SPDX-License-Identifier: BSD-3-Clause
// Joints on a path of which one faults, yields or is stopped: how the others stop, and how the state tells it. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "daemon/realtime/path/path_follower.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr std::size_t kGrouped = 4;

/// Each its own way, up to 0.75 rad/s.
KnotPath grouped_way(std::size_t joint) {
  const double far_rad = 0.5 - 0.1 * static_cast<double>(joint);
  KnotPath path;
  path.count = 4;
  path.knots[1] = {0.7, 0.6 * far_rad, 1.2 * far_rad};
  path.knots[2] = {1.2, far_rad, 0.0};
  path.knots[3] = {2.0, (0.3 + 0.15 * static_cast<double>(joint)) * far_rad, 0.0};
  return path;
}

enum class OnFault { kJoint, kGroup };

BenchJoint grouped(OnFault on_fault) {
  BenchJoint joint = demo_joint();
  joint.loop.group = 0;
  joint.loop.fault_stops_group = on_fault == OnFault::kGroup;
  return joint;
}

class GroupOnAPath : public ::testing::Test {
 protected:
  void begin(std::vector<BenchJoint> joints) {
    bench_.emplace(joints);
    for (std::size_t i = 0; i < kGrouped; ++i) bench_->bring_to_hold(i);
    for (std::size_t i = 0; i < kGrouped; ++i) {
      const auto slot = bench_->joint(i).path_slots().hand_over({7, kGrouped, grouped_way(i)});
      ASSERT_EQ(bench_->order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
                Reason::kAccepted);
    }
    ASSERT_EQ(bench_->order(0, OrderKind::kResumePath), Reason::kAccepted);
  }
  void begin(OnFault on_fault) { begin(std::vector<BenchJoint>(kGrouped, grouped(on_fault))); }
  /// The farthest that the others of `lost` are from the one time of the path that is nearest to all of them.
  double off_path_rad(std::size_t lost) const {
    double least_rad = 1e9;
    for (double s = 0.0; s <= 2.0; s += 2e-4) {
      double farthest_rad = 0.0;
      for (std::size_t i = 0; i < kGrouped; ++i)
        if (i != lost)
          farthest_rad = std::max(farthest_rad, std::abs(PathReader().at(grouped_way(i), s).position_rad -
                                                         bench_->state(i).joint_position_rad));
      least_rad = std::min(least_rad, farthest_rad);
    }
    return least_rad;
  }
  template <typename Is>
  bool others(std::size_t lost, const Is& is) const {
    for (std::size_t i = 0; i < kGrouped; ++i)
      if (i != lost && !is(i)) return false;
    return true;
  }
  bool others_are(std::size_t lost, Mode mode) const {
    return others(lost, [&](std::size_t i) { return bench_->mode(i) == mode; });
  }

  std::optional<JointBench> bench_;
};

// They fell from the path at speed: friction alone stopped them, each after its own way.
TEST_F(GroupOnAPath, ComesToRestAlongItAndFaultsThen) {
  for (const double after_s : {0.3, 0.6, 0.9, 1.6}) {
    begin(OnFault::kGroup);
    bench_->run(after_s);
    bench_->inject(1, {InjectedFault::kSensorNan});
    bench_->step();
    ASSERT_EQ(bench_->fault(1), Fault::kImplausibleReading);
    double farthest_rad = 0.0;
    int periods = 0;
    for (; others_are(1, Mode::kTracking) && periods < 1000; ++periods) {
      farthest_rad = std::max(farthest_rad, off_path_rad(1));
      EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->has_notice(i, Notice::kPathEnds); }));
      EXPECT_TRUE(others(1, [&](std::size_t i) {
        return bench_->state(i).target_position_rad == grouped_way(i).last().position_rad;
      }));
      bench_->step();
    }
    EXPECT_TRUE(others_are(1, Mode::kHolding)) << "in one cycle, in which they fault";
    bench_->step();
    EXPECT_LT(periods, 300);
    EXPECT_LT(farthest_rad, 1e-3) << after_s;
    EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->fault(i) == Fault::kGroup; }))
        << "in one cycle";
    EXPECT_TRUE(others(1, [&](std::size_t i) { return !bench_->drive(i).command().enable; }));
    EXPECT_TRUE(others(1, [&](std::size_t i) { return !bench_->has_notice(i, Notice::kPathEnds); }));
    bench_->run(0.3);
    EXPECT_LT(off_path_rad(1), 1e-3) << after_s;
  }
}

// What follows its setpoint later than others rests later.
TEST_F(GroupOnAPath, FaultsOnlyWhenTheLastOfItRests) {
  std::vector<BenchJoint> joints(kGrouped, grouped(OnFault::kGroup));
  joints[2].loop.controller.jerk_limit_rad_s3 = 1500.0;
  begin(joints);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kSensorNan});
  bench_->step();
  double last_rad_s = 1.0;
  for (int k = 0; k < 1000 && bench_->mode(2) == Mode::kTracking; ++k) {
    last_rad_s = std::max({std::abs(bench_->state(0).setpoint_velocity_rad_s),
                           std::abs(bench_->state(2).setpoint_velocity_rad_s),
                           std::abs(bench_->state(3).setpoint_velocity_rad_s)});
    bench_->step();
  }
  EXPECT_LT(last_rad_s, 1e-9);
  bench_->step();
  EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->fault(i) == Fault::kGroup; }));
}

TEST_F(GroupOnAPath, StopsAtOnceAfterAFaultThatTellsOfMoreThanOneJoint) {
  begin(OnFault::kGroup);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kPowerLost});
  bench_->step();
  EXPECT_EQ(bench_->fault(1), Fault::kPowerLost);
  EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->fault(i) == Fault::kGroup; }));
}

TEST_F(GroupOnAPath, StopsAtOnceWhenASecondFaultTellsOfMoreThanOneJoint) {
  begin(OnFault::kGroup);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kSensorNan});
  bench_->run(0.03);
  ASSERT_TRUE(others_are(1, Mode::kTracking));
  bench_->inject(2, {InjectedFault::kPowerLost});
  bench_->step();
  EXPECT_EQ(bench_->fault(2), Fault::kPowerLost);
  EXPECT_EQ(bench_->fault(0), Fault::kGroup);
  EXPECT_EQ(bench_->fault(3), Fault::kGroup);
}

TEST_F(GroupOnAPath, StopsAJointAtOnceThatAnOrderTakesOffThePath) {
  begin(OnFault::kGroup);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kSensorNan});
  bench_->run(0.03);
  EXPECT_EQ(bench_->order(0, OrderKind::kResumePath), Reason::kWrongMode);
  ASSERT_EQ(bench_->move(3, 0.5), Reason::kAccepted);
  bench_->step();
  EXPECT_EQ(bench_->fault(3), Fault::kGroup);
  EXPECT_EQ(bench_->mode(0), Mode::kTracking);
  bench_->run(0.3);
  EXPECT_EQ(bench_->fault(0), Fault::kGroup);
}

TEST_F(GroupOnAPath, StopsAtOnceAJointThatIsOnNone) {
  std::vector<BenchJoint> joints(kGrouped + 1, grouped(OnFault::kGroup));
  begin(joints);
  bench_->bring_to_hold(kGrouped);
  ASSERT_EQ(bench_->move(kGrouped, 1.0), Reason::kAccepted);
  bench_->run(0.2);
  bench_->inject(1, {InjectedFault::kSensorNan});
  bench_->step();
  EXPECT_EQ(bench_->fault(kGrouped), Fault::kGroup);
  EXPECT_TRUE(others_are(1, Mode::kTracking));
}

// Not of the path: its fault stops the group that is on one all the same.
TEST_F(GroupOnAPath, ComesToRestAlongItWhenAJointOfTheGroupFaultsThatIsOnNone) {
  std::vector<BenchJoint> joints(kGrouped + 1, grouped(OnFault::kGroup));
  begin(joints);
  bench_->bring_to_hold(kGrouped);
  bench_->inject(kGrouped, {InjectedFault::kSensorNan});
  bench_->step();
  EXPECT_TRUE(others_are(kGrouped, Mode::kTracking));
  bench_->run(0.4);
  EXPECT_LT(off_path_rad(kGrouped), 1e-3);
  EXPECT_TRUE(others(kGrouped, [&](std::size_t i) { return bench_->fault(i) == Fault::kGroup; }));
}

TEST_F(GroupOnAPath, HoldsOnItAfterAFaultThatStopsOnlyItsJoint) {
  begin(OnFault::kJoint);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kSensorNan});
  bench_->run(0.01);
  EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->has_notice(i, Notice::kPathEnds); }));
  bench_->run(0.4);
  EXPECT_TRUE(others_are(1, Mode::kHolding));
  EXPECT_LT(off_path_rad(1), 1e-3);
  EXPECT_TRUE(others(1, [&](std::size_t i) { return !bench_->has_notice(i, Notice::kPathEnds); }));
}

// Along the path it takes a tenth of a second and more.
TEST_F(GroupOnAPath, StopsEachOnItsOwnAtOnceAndHoldsAfterAFaultThatStopsOnlyItsJointButTellsOfMore) {
  begin(OnFault::kJoint);
  bench_->run(0.6);
  bench_->inject(1, {InjectedFault::kPowerLost});
  bench_->run(0.02);
  EXPECT_TRUE(others_are(1, Mode::kHolding));
  EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->state(i).setpoint_velocity_rad_s == 0.0; }));
  bench_->run(0.3);
  EXPECT_TRUE(others_are(1, Mode::kHolding));
}

// One joint of the path runs into something and yields, which is no fault.
TEST_F(GroupOnAPath, StopsEachOnItsOwnAtOnceWhenOneYieldsToAWall) {
  std::vector<BenchJoint> joints(kGrouped, grouped(OnFault::kGroup));
  JointLoopConfig& loop = joints[1].loop;
  joints[1].drive.plant.effects.contact = {0.15, 2000.0, 0.2 * std::sqrt(2000.0 * 0.089)};
  loop.limits.load.load_Nm = 8.0;
  loop.limits.load.notice_Nm = 6.0;
  loop.overload_stop = OverloadStop::kHoldLoad;
  begin(joints);
  bench_->run(0.1);
  ASSERT_GE(
      bench_->step_until(
          [&] { return bench_->state(1).target_position_rad != grouped_way(1).last().position_rad; }, 1000),
      0);
  ASSERT_EQ(bench_->fault(1), Fault::kNone) << "it yields";
  bench_->run(0.02);
  EXPECT_TRUE(others_are(1, Mode::kHolding));
  EXPECT_TRUE(others(1, [&](std::size_t i) { return bench_->state(i).setpoint_velocity_rad_s == 0.0; }));
}

TEST_F(GroupOnAPath, TellsOfAnEndThatIsOrdered) {
  begin(OnFault::kGroup);
  bench_->run(0.6);
  EXPECT_FALSE(bench_->has_notice(2, Notice::kPathEnds));
  ASSERT_EQ(bench_->order(0, OrderKind::kHold), Reason::kAccepted);
  bench_->step();
  EXPECT_TRUE(others(kGrouped, [&](std::size_t i) { return bench_->has_notice(i, Notice::kPathEnds); }));
  bench_->run(0.4);
  EXPECT_TRUE(others_are(kGrouped, Mode::kHolding));
  EXPECT_TRUE(others(kGrouped, [&](std::size_t i) { return !bench_->has_notice(i, Notice::kPathEnds); }));
}

}  // namespace
}  // namespace strainwave::testing
