// SPDX-License-Identifier: BSD-3-Clause
// Paths that rest for some milliseconds, as where one turns at a knot. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "daemon/realtime/path/path_follower.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

/// Slowly there, a rest of `rest_s`, and slowly back; `later_s` shifts the turn against the periods.
KnotPath turning(double rest_s, double later_s, double scale) {
  KnotPath path;
  const double there_s = 0.55 + later_s, back_s = there_s + rest_s;
  path.knots[1] = {0.5 + later_s, -0.05 * scale, -0.02 * scale};
  path.knots[2] = {there_s, -0.0505 * scale, 0.0};
  path.knots[3] = {back_s, -0.0505 * scale, 0.0};
  path.knots[4] = {back_s + 0.05, -0.0499 * scale, 0.0175 * scale};
  path.knots[5] = {back_s + 0.65, 0.0, 0.0};
  path.count = 6;
  return path;
}

void begin(JointBench& bench, const KnotPath& path) {
  const auto slot = bench.joint(0).path_slots().hand_over({7, 1, path});
  EXPECT_EQ(bench.order(0, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
            Reason::kAccepted);
  EXPECT_EQ(bench.order(0, OrderKind::kResumePath), Reason::kAccepted);
}

/// How far the joint is from its setpoint at most, about the turn.
double farthest_rad(double rest_s, double later_s, double scale, double temperature_C, double friction) {
  BenchJoint joint = demo_joint_with_friction(friction);
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  JointBench bench({joint});
  bench.bring_to_hold(0);
  begin(bench, turning(rest_s, later_s, scale));
  double farthest_rad = 0.0;
  for (int k = 1; k < 1700; ++k) {
    bench.step();
    const state_v1& state = bench.state(0);
    if (k > 500 && k < 900)
      farthest_rad = std::max(farthest_rad, std::abs(state.joint_position_rad - state.setpoint_position_rad));
  }
  EXPECT_EQ(bench.mode(0), Mode::kHolding);
  return farthest_rad;
}

// Slow break-aways and short rests, whatever the friction.
TEST(RestingPath, DoesNotThrowTheJointOff) {
  for (const double friction : {0.8, 1.0, 1.2})
    for (const double scale : {1.0, 5.0})
      for (const double rest_s : {0.003, 0.008, 0.018, 0.05, 0.3})
        for (const double temperature_C : {-8.0, 5.0, 25.0, 40.0})
          for (int i = 0; i < 4; ++i)
            EXPECT_LT(farthest_rad(rest_s, 0.00237 * i, scale, temperature_C, friction), 0.55e-3)
                << rest_s << " s, " << temperature_C << " degC, friction " << friction;
}

/// How a joint comes back to where its path rests, and stays there.
struct Return {
  int starts = 0;  ///< of its setpoint
  bool off_stream = false;
  double left_rad = 0.0;  ///< 0.65 s after the push
};

Return pushed_while_it_rests(double push_Nm, double later_s, double temperature_C, double friction) {
  BenchJoint joint = demo_joint_with_friction(friction);
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  JointBench bench({joint});
  bench.bring_to_hold(0);
  const KnotPath path = turning(1.0, later_s, 1.0);
  begin(bench, path);
  bench.run(0.8);
  bench.drive(0).simulated().set_load_torque_Nm(push_Nm);
  bench.run(0.01);
  bench.drive(0).simulated().set_load_torque_Nm(0.0);
  const double place_rad = path.knots[2].position_rad;
  Return back;
  bool moved = false;
  for (int k = 0; k < 650; ++k) {
    bench.step();
    const bool moves = std::abs(bench.state(0).setpoint_position_rad - place_rad) > 1e-9;
    back.starts += moves && !moved ? 1 : 0;
    moved = moves;
    back.off_stream = back.off_stream || bench.has_notice(0, Notice::kOffStream);
  }
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  back.left_rad = std::abs(bench.drive(0).simulated().plant().state().position_rad - place_rad);
  return back;
}

TEST(RestingPath, IsComeBackToByAJointThatIsPushed) {
  double farthest_rad = 0.0;
  int most = 0;
  for (const double friction : {0.8, 1.0, 1.2})
    for (const double temperature_C : {-8.0, 5.0, 25.0})
      for (const double push_Nm : {5.0, 8.0, 12.0})
        for (int i = 0; i < 4; ++i) {
          const Return back = pushed_while_it_rests(push_Nm, 0.00237 * i, temperature_C, friction);
          farthest_rad = std::max(farthest_rad, back.left_rad);
          most = std::max(most, back.starts);
          EXPECT_FALSE(back.off_stream) << push_Nm << " N.m at " << temperature_C << " degC";
        }
  EXPECT_LT(farthest_rad, 0.15e-3);
  EXPECT_LE(most, 6);
}

// A motor that sticks a little off goes to its place by a motion of its own, after the path.
TEST(RestingPath, IsNotLeftByAFlexibleJointThatCorrectsWhereItRests) {
  for (const double temperature_C : {-8.0, 5.0, 25.0, 38.0})
    for (const double scale : {1.0, 5.0}) {
      BenchJoint joint = flexible_joint();
      joint.drive.ambient = TemperatureProfile::constant(temperature_C);
      JointBench bench({joint});
      bench.bring_to_hold(0, flexible_table());
      begin(bench, turning(0.3, 0.0, scale));
      for (int k = 0; k < 2000; ++k) {
        bench.step();
        EXPECT_FALSE(bench.has_notice(0, Notice::kOffStream)) << temperature_C << " degC, " << k << " ms";
      }
    }
}

}  // namespace
}  // namespace strainwave::testing
