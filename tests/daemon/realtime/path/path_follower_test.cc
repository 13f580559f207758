// SPDX-License-Identifier: BSD-3-Clause
// Joints on paths in virtual time: real joint loops with simulated drives.
#include "daemon/realtime/path/path_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/allocation_trap.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr std::size_t kJoints = 6;
constexpr double kPeriod_s = 0.001;
/// For the demonstration's joint with friction and delay. The deviation is largest at a reversal, where friction changes its sign.
constexpr double kDeviation_rad = 1e-3;

KnotPath path_of(std::initializer_list<PathKnot> knots) {
  KnotPath path;
  path.count = knots.size();
  std::copy(knots.begin(), knots.end(), path.knots.begin());
  return path;
}

/// Rounding of a velocity that should be 0.
constexpr double kStands_rad_s = 1e-9;

/// There and back in 2 s, with a different way for each joint, up to 0.8 rad/s and 6.7 rad/s^2.
KnotPath wave(std::size_t joint) {
  const double size_rad = 0.2 + 0.08 * static_cast<double>(joint);
  return path_of({{0.0, 0.0, 0.0},
                  {0.5, 0.5 * size_rad, 1.2 * size_rad},
                  {1.0, size_rad, 0.0},
                  {1.4, 0.6 * size_rad, -1.1 * size_rad},
                  {2.0, 0.1 * static_cast<double>(joint), 0.0}});
}

/// The setpoint and position of a joint in each cycle.
struct Trace {
  std::vector<state_v1> states;
  std::int64_t first_motion(double begins_rad) const {
    for (const state_v1& state : states)
      if (state.setpoint_position_rad != begins_rad || state.setpoint_velocity_rad_s != 0.0)
        return state.cycle;
    return -1;
  }
  std::int64_t last_motion() const {
    std::int64_t last = -1;
    for (const state_v1& state : states)
      if (std::abs(state.setpoint_velocity_rad_s) > kStands_rad_s) last = state.cycle;
    return last;
  }
};

class PathFollowerTest : public ::testing::Test {
 protected:
  explicit PathFollowerTest(std::vector<BenchJoint> joints = std::vector<BenchJoint>(kJoints, demo_joint()))
      : bench_(joints), traces_(joints.size()) {
    for (std::size_t i = 0; i < joints.size(); ++i) bench_.bring_to_hold(i);
  }
  Reason load(std::size_t joint, const KnotPath& path, std::int32_t joint_count = kJoints,
              std::int64_t id = 7) {
    const auto slot = bench_.joint(joint).joint().path_slots.hand_over({id, joint_count, path});
    EXPECT_TRUE(slot);
    return bench_.order(joint, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)});
  }
  void load_all() {
    for (std::size_t i = 0; i < kJoints; ++i) ASSERT_EQ(load(i, wave(i)), Reason::kAccepted) << i;
  }
  void begin() {
    load_all();
    ASSERT_EQ(bench_.order(2, OrderKind::kResumePath), Reason::kAccepted);
  }
  void step() {
    bench_.step();
    for (std::size_t i = 0; i < traces_.size(); ++i) traces_[i].states.push_back(bench_.state(i));
  }
  void run(double duration_s) {
    for (int i = 0; i < static_cast<int>(duration_s / kPeriod_s); ++i) step();
  }
  bool all_are(Mode mode) const {
    for (std::size_t i = 0; i < traces_.size(); ++i)
      if (bench_.mode(i) != mode) return false;
    return true;
  }
  JointBench bench_;
  std::vector<Trace> traces_;
};

TEST_F(PathFollowerTest, NothingMovesBeforeEveryJointHasItsPart) {
  for (std::size_t i = 0; i + 1 < kJoints; ++i) ASSERT_EQ(load(i, wave(i)), Reason::kAccepted);
  EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kWrongMode);
  EXPECT_EQ(bench_.last_reply().value, 5.0);
  EXPECT_EQ(bench_.last_reply().limit, 6.0);
  EXPECT_EQ(bench_.order(5, OrderKind::kResumePath), Reason::kWrongMode);
  run(0.1);
  EXPECT_TRUE(all_are(Mode::kHolding));
  for (const Trace& trace : traces_) EXPECT_EQ(trace.first_motion(0.0), -1);
}

TEST_F(PathFollowerTest, NothingMovesWhenOneJointIsNotWhereItsPathBegins) {
  KnotPath elsewhere = wave(3);
  for (std::size_t i = 0; i < elsewhere.count; ++i) elsewhere.knots[i].position_rad += 0.002;
  EXPECT_EQ(load(3, elsewhere), Reason::kOutOfRange);
  EXPECT_NEAR(bench_.last_reply().value, 0.002, 1e-9);
  load_all();
  ASSERT_EQ(bench_.move(4, 0.1), Reason::kAccepted);
  EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kMoving);
  run(1.0);
  EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kOutOfRange);
  run(0.1);
  EXPECT_TRUE(all_are(Mode::kHolding));
  EXPECT_EQ(traces_[0].first_motion(0.0), -1);
}

TEST_F(PathFollowerTest, StatesTellWhereAPathIsAndThatItIsPaused) {
  const auto paused = [this](std::size_t joint) {
    return (bench_.state(joint).notices & static_cast<std::int32_t>(Notice::kPathPaused)) != 0;
  };
  EXPECT_TRUE(std::isnan(bench_.state(2).path_time_s)) << "on no path yet";
  begin();
  run(0.7);
  EXPECT_NEAR(bench_.state(2).path_time_s, 0.7, 0.01);
  EXPECT_FALSE(paused(2));
  ASSERT_EQ(bench_.order(5, OrderKind::kPausePath), Reason::kAccepted);
  run(0.3);
  const double paused_s = bench_.state(0).path_time_s;
  EXPECT_GT(paused_s, 0.7);
  EXPECT_LT(paused_s, 1.0);
  run(1.0);
  for (std::size_t i = 0; i < kJoints; ++i) {
    EXPECT_TRUE(paused(i)) << i;
    EXPECT_EQ(bench_.state(i).path_time_s, paused_s) << i;
  }
  ASSERT_EQ(bench_.order(1, OrderKind::kResumePath), Reason::kAccepted);
  run(0.2);
  EXPECT_FALSE(paused(0));
  EXPECT_GT(bench_.state(0).path_time_s, paused_s);
  ASSERT_EQ(bench_.order(1, OrderKind::kHold), Reason::kAccepted);
  run(0.01);
  EXPECT_TRUE(std::isnan(bench_.state(0).path_time_s));
  EXPECT_FALSE(paused(0));
}

/// Events that end the motion of one joint, also a wall. The other joints must stop.
class PathEnds : public PathFollowerTest {
 protected:
  static constexpr std::size_t kLost = 4;
  PathEnds() : PathFollowerTest(joints()) {
    begin();
    run(0.4);
  }
  static std::vector<BenchJoint> joints() {
    std::vector<BenchJoint> joints(kJoints, demo_joint());
    joints[kLost].drive.plant.effects.contact = {0.25, 2000.0, 0.2 * std::sqrt(2000.0 * 0.089)};
    joints[kLost].loop.limits.load.load_Nm = 8.0;
    joints[kLost].loop.limits.load.notice_Nm = 6.0;
    joints[kLost].loop.overload_stop = OverloadStop::kHoldLoad;
    return joints;
  }
  /// Within the time of the deceleration from 0.8 rad/s. Along the path it would take a tenth of a second and more.
  void expect_the_others_to_stop_at_once() {
    run(0.04);
    for (std::size_t i = 0; i < kJoints; ++i) {
      if (i == kLost) continue;
      EXPECT_EQ(bench_.mode(i), Mode::kHolding) << i;
      EXPECT_LT(std::abs(bench_.state(i).setpoint_velocity_rad_s), kStands_rad_s) << i;
      EXPECT_TRUE(std::isnan(bench_.state(i).path_time_s)) << i;
    }
    EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kWrongMode) << "it is over";
  }
};

TEST_F(PathEnds, AtOnceWhenOneJointIsHeld) {
  ASSERT_EQ(bench_.order(kLost, OrderKind::kHold), Reason::kAccepted);
  expect_the_others_to_stop_at_once();
}

TEST_F(PathEnds, AtOnceWhenOneJointIsDisabled) {
  ASSERT_EQ(bench_.order(kLost, OrderKind::kDisable), Reason::kAccepted);
  expect_the_others_to_stop_at_once();
}

TEST_F(PathEnds, AtOnceWhenOneJointFaults) {
  ASSERT_EQ(bench_.inject(kLost, {InjectedFault::kSensorNan}), Reason::kAccepted);
  expect_the_others_to_stop_at_once();
}

TEST_F(PathEnds, AtOnceWhenOneJointYieldsToAWall) {
  ASSERT_GE(bench_.step_until([&] { return bench_.has_notice(kLost, Notice::kYielded); }, 1000), 0);
  expect_the_others_to_stop_at_once();
  EXPECT_EQ(bench_.fault(kLost), Fault::kNone);
}

TEST_F(PathFollowerTest, AMoveTakesAJointOffThePathAndTheOthersRest) {
  begin();
  run(0.5);
  ASSERT_EQ(bench_.move(1, -0.5), Reason::kAccepted);
  run(1.5);
  EXPECT_TRUE(all_are(Mode::kHolding));
  EXPECT_NEAR(bench_.state(1).joint_position_rad, -0.5, 1e-3);
  EXPECT_LT(traces_[0].last_motion(), traces_[1].last_motion());
}

TEST_F(PathFollowerTest, APathIsTakenOnlyWhileTheJointHolds) {
  begin();
  run(0.3);
  EXPECT_EQ(load(0, wave(0)), Reason::kMoving);
  ASSERT_EQ(bench_.order(0, OrderKind::kDisable), Reason::kAccepted);
  run(1.0);
  EXPECT_EQ(load(0, wave(0)), Reason::kWrongMode);
  EXPECT_EQ(bench_.order(1, OrderKind::kPausePath), Reason::kWrongMode);
}

TEST_F(PathFollowerTest, AHoldForgetsAPathThatHasNotBegun) {
  load_all();
  ASSERT_EQ(bench_.order(0, OrderKind::kHold), Reason::kAccepted);
  EXPECT_EQ(bench_.order(1, OrderKind::kResumePath), Reason::kWrongMode);
  EXPECT_EQ(bench_.last_reply().value, 5.0);
}

// A joint is lost in the very cycle of the order. None of the others may begin.
TEST_F(PathFollowerTest, NobodyBeginsWhenOneIsStoppedInTheCycleOfTheStart) {
  load_all();
  ASSERT_TRUE(bench_.joint(5).orders().push(Order{.kind = OrderKind::kDisable}));
  ASSERT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
  run(0.5);
  for (std::size_t i = 0; i + 1 < kJoints; ++i) {
    EXPECT_EQ(bench_.mode(i), Mode::kHolding) << i;
    EXPECT_EQ(traces_[i].first_motion(0.0), -1) << i;
  }
}

TEST_F(PathFollowerTest, TwoPathsAreTravelledAtATime) {
  for (std::size_t i = 0; i < kJoints; ++i) ASSERT_EQ(load(i, wave(i), 3, i < 3 ? 7 : 8), Reason::kAccepted);
  ASSERT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
  run(0.3);
  ASSERT_EQ(bench_.order(5, OrderKind::kResumePath), Reason::kAccepted);
  ASSERT_EQ(bench_.order(1, OrderKind::kHold), Reason::kAccepted);
  run(2.5);
  EXPECT_TRUE(all_are(Mode::kHolding));
  EXPECT_LT(bench_.state(2).joint_position_rad, 0.3);
  for (std::size_t i = 3; i < kJoints; ++i)
    EXPECT_NEAR(bench_.state(i).joint_position_rad, wave(i).last().position_rad, kDeviation_rad) << i;
}

TEST_F(PathFollowerTest, ArrivesWhereItEndsAfterPeriodsThatWereMissed) {
  begin();
  run(0.5);
  bench_.stall(4);
  run(2.0);
  EXPECT_TRUE(all_are(Mode::kHolding));
  for (std::size_t i = 0; i < kJoints; ++i) {
    EXPECT_NEAR(bench_.state(i).joint_position_rad, wave(i).last().position_rad, kDeviation_rad) << i;
  }
}

TEST_F(PathFollowerTest, AllocatesNothing) {
  if (!AllocationTrap::available()) GTEST_SKIP() << "the sanitizer has its own malloc";
  const AllocationTrap trap;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < kJoints; ++i) {
      KnotPath back = wave(i);
      const double from_rad = bench_.state(i).target_position_rad;
      for (std::size_t k = 0; k < back.count; ++k)
        back.knots[k].position_rad += from_rad - back.knots[0].position_rad;
      ASSERT_EQ(load(i, back), Reason::kAccepted);
    }
    ASSERT_EQ(bench_.order(1, OrderKind::kResumePath), Reason::kAccepted);
    bench_.run(0.5);
    ASSERT_EQ(bench_.order(1, OrderKind::kPausePath), Reason::kAccepted);
    bench_.run(0.3);
    ASSERT_EQ(bench_.order(1, OrderKind::kResumePath), Reason::kAccepted);
    bench_.run(0.2);
    ASSERT_EQ(bench_.order(1, OrderKind::kHold), Reason::kAccepted);
    bench_.run(0.5);
  }
  EXPECT_EQ(trap.touches(), 0);
}

}  // namespace
}  // namespace strainwave::testing
