// Paths of joints that may hang on a spring that nobody told of: their setpoints are eased as in moves. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "daemon/realtime/path_follower.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kEasedFar_rad = 0.4;
constexpr double kEasedLast_s = 1.2;
/// What the path's own acceleration steps by at each of its knots.
constexpr double kKnotStep_rad_s2 = 15.0;
/// The mean over 20 ms leaves a twentieth of that in a period; what the cubic itself changes is another tenth.
constexpr double kEasedKnotStep_rad_s2 = 0.9;
constexpr int kEasedLater = 10;  // periods; its last begins and ends a mean of 20 later

/// There, a rest, and back.
KnotPath knotted() {
  KnotPath path;
  path.count = 4;
  path.knots[1] = {0.4, kEasedFar_rad, 0.0};
  path.knots[2] = {0.8, kEasedFar_rad, 0.0};
  path.knots[3] = {kEasedLast_s, 0.0, 0.0};
  return path;
}

struct KnottedWay {
  double largest_step_rad_s2 = 0.0;  ///< of the setpoint's acceleration from one period to the next
  int half_way = 0;                  ///< periods until its setpoint first is
  int arrives = 0;                   ///< until it holds
  std::vector<double> setpoint_rad{};
  std::vector<double> link_rad{};
};

std::vector<KnottedWay> follow_knots(const std::vector<BenchJoint>& joints,
                                     const std::vector<GainTable>& tables, std::int64_t stall = 0) {
  JointBench bench(joints, {1000, 2.0, 1.0});
  for (std::size_t i = 0; i < joints.size(); ++i) bench.bring_to_hold(i, tables[i]);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto slot =
        bench.joint(i).path_slots().hand_over({7, static_cast<std::int32_t>(joints.size()), knotted()});
    EXPECT_EQ(bench.order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
              Reason::kAccepted);
  }
  EXPECT_EQ(bench.order(0, OrderKind::kResumePath), Reason::kAccepted);
  std::vector<KnottedWay> ways(joints.size());
  std::vector<double> velocity_rad_s(joints.size());
  std::vector<double> acceleration_rad_s2(joints.size());
  for (int k = 1; k < 1500; ++k) {
    if (stall > 0 && k == 200) bench.stall(stall);
    bench.step();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const state_v1& state = bench.state(i);
      const double now_rad_s2 = 1e3 * (state.setpoint_velocity_rad_s - velocity_rad_s[i]);
      ways[i].largest_step_rad_s2 =
          std::max(ways[i].largest_step_rad_s2, std::abs(now_rad_s2 - acceleration_rad_s2[i]));
      acceleration_rad_s2[i] = now_rad_s2;
      velocity_rad_s[i] = state.setpoint_velocity_rad_s;
      if (bench.mode(i) == Mode::kTracking) ways[i].arrives = k;
      if (ways[i].half_way == 0 && state.setpoint_position_rad > 0.5 * kEasedFar_rad) ways[i].half_way = k;
      ways[i].setpoint_rad.push_back(state.setpoint_position_rad);
      ways[i].link_rad.push_back(bench.drive(i).simulated().plant().link_state().position_rad);
    }
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    EXPECT_EQ(bench.mode(i), Mode::kHolding) << i;
    EXPECT_NEAR(bench.state(i).joint_position_rad, knotted().last().position_rad, 1e-3) << i;
  }
  return ways;
}

TEST(EasedPath, HasNoStepOfTheAccelerationAtKnotsAndIsTenMillisecondsLater) {
  const KnottedWay eased = follow_knots({flexible_joint(false)}, {flexible_table()})[0];
  std::printf("untold: the acceleration steps by %.2f rad/s^2, holds after %d ms\n",
              eased.largest_step_rad_s2, eased.arrives);
  EXPECT_LT(eased.largest_step_rad_s2, kEasedKnotStep_rad_s2);
  const KnottedWay rigid = follow_knots({demo_joint()}, {demo_table()})[0];
  std::printf("rigid: the acceleration steps by %.2f rad/s^2, holds after %d ms\n", rigid.largest_step_rad_s2,
              rigid.arrives);
  EXPECT_NEAR(rigid.largest_step_rad_s2, kKnotStep_rad_s2, 0.2) << "who is rigid is not eased";
  EXPECT_NEAR(eased.half_way - rigid.half_way, kEasedLater, 1);
  EXPECT_NEAR(eased.arrives - rigid.arrives, 2 * kEasedLater, 2);
}

// Who is not eased waits for who is.
TEST(EasedPath, IsGoneTogetherWithJointsThatAreNotEased) {
  const std::vector<KnottedWay> ways =
      follow_knots({flexible_joint(false), demo_joint(), flexible_joint(true)},
                   {flexible_table(), demo_table(), flexible_table()});
  double apart_rad = 0.0;
  for (std::size_t k = 0; k < ways[0].link_rad.size(); ++k)
    for (const KnottedWay& way : ways)
      apart_rad = std::max(apart_rad, std::abs(way.link_rad[k] - ways[1].link_rad[k]));
  std::printf("eased, rigid and told of its spring: links at most %.2e rad apart\n", apart_rad);
  EXPECT_LT(apart_rad, 1e-3) << "ten periods of the path's speed are 15 mrad";
  EXPECT_LT(ways[0].largest_step_rad_s2, kEasedKnotStep_rad_s2);
}

TEST(EasedPath, StaysEasedAfterAStallOverWhichNobodyKnowsWhatTheJointDid) {
  const KnottedWay way = follow_knots({flexible_joint(false)}, {flexible_table()}, 40)[0];
  // The stall's own cycle, in which the setpoint begins anew where the joint is, is a step.
  const std::size_t stalled = 200;
  double largest_rad_s2 = 0.0;
  for (std::size_t k = stalled + 5; k + 1 < way.setpoint_rad.size(); ++k) {
    const auto acceleration_rad_s2 = [&](std::size_t at) {
      return 1e6 * (way.setpoint_rad[at + 1] - 2.0 * way.setpoint_rad[at] + way.setpoint_rad[at - 1]);
    };
    largest_rad_s2 = std::max(largest_rad_s2, std::abs(acceleration_rad_s2(k) - acceleration_rad_s2(k - 1)));
  }
  std::printf("after a stall the acceleration steps by %.2f rad/s^2\n", largest_rad_s2);
  EXPECT_LT(largest_rad_s2, 2.0 * kEasedKnotStep_rad_s2);
}

// A rest of what was begun: an eased move before it, and one after it.
TEST(EasedPath, BeginsAfterAnEasedMoveAndIsFollowedByOne) {
  JointBench bench({flexible_joint(false)});
  bench.bring_to_hold(0, flexible_table());
  ASSERT_EQ(bench.move(0, 0.1), Reason::kAccepted);
  bench.run(1.0);
  ASSERT_EQ(bench.move(0, 0.0), Reason::kAccepted);
  bench.run(1.0);
  const auto slot = bench.joint(0).path_slots().hand_over({7, 1, knotted()});
  ASSERT_EQ(bench.order(0, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
            Reason::kAccepted);
  ASSERT_EQ(bench.order(0, OrderKind::kResumePath), Reason::kAccepted);
  double velocity_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double largest_rad_s2 = 0.0;
  for (int k = 0; k < 1500; ++k) {
    bench.step();
    const double now_rad_s2 = 1e3 * (bench.state(0).setpoint_velocity_rad_s - velocity_rad_s);
    largest_rad_s2 = std::max(largest_rad_s2, std::abs(now_rad_s2 - acceleration_rad_s2));
    velocity_rad_s = bench.state(0).setpoint_velocity_rad_s;
    acceleration_rad_s2 = now_rad_s2;
  }
  EXPECT_LT(largest_rad_s2, kEasedKnotStep_rad_s2);
  ASSERT_EQ(bench.move(0, 0.3), Reason::kAccepted);
  bench.run(1.0);
  EXPECT_EQ(bench.state(0).setpoint_position_rad, 0.3);
  EXPECT_EQ(bench.mode(0), Mode::kHolding);
}

}  // namespace
}  // namespace strainwave::testing
