// SPDX-License-Identifier: BSD-3-Clause
// Loss and return of the temperature signal under control, and the torque of a hot joint. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

struct ChangeOver {
  double torque_step_Nm;  ///< between the cycles before and after it
  double usual_step_Nm;   ///< largest between any other two cycles around it
};

class TemperatureLoss : public ::testing::TestWithParam<double> {
 protected:
  static BenchJoint joint() {
    BenchJoint joint = demo_joint();
    joint.loop.temperature.max_age_s = 0.5;
    joint.drive.ambient = TemperatureProfile::constant(GetParam());
    return joint;
  }

  /// Runs until the temperature becomes `valid` or not. Returns the torque's steps around that cycle.
  ChangeOver change_over(JointBench& bench, bool valid) {
    ChangeOver result{0.0, 0.0};
    double previous_Nm = bench.state(0).torque_commanded_Nm;
    bool changed = false;
    for (int after = 0; after < 100; after += changed ? 1 : 0) {
      bench.step();
      const double step_Nm = std::abs(bench.state(0).torque_commanded_Nm - previous_Nm);
      previous_Nm = bench.state(0).torque_commanded_Nm;
      const bool is_valid = bench.state(0).temperature_status == static_cast<int>(TemperatureStatus::kValid);
      const bool now = !changed && is_valid == valid;
      if (now)
        result.torque_step_Nm = step_Nm;
      else
        result.usual_step_Nm = std::max(result.usual_step_Nm, step_Nm);
      changed = changed || now;
      if (bench.cycle() > 60000) ADD_FAILURE() << "no change-over";
      if (bench.cycle() > 60000) break;
    }
    return result;
  }
};

TEST_P(TemperatureLoss, MakesNoTorqueStepAtRestNorDoesItsReturn) {
  JointBench bench({joint()});
  bench.bring_to_hold(0);
  bench.drive(0).simulated().set_load_torque_Nm(5.0);
  bench.run(2.0);
  bench.inject(0, {InjectedFault::kTemperatureLost});
  const ChangeOver away = change_over(bench, false);
  EXPECT_LE(away.torque_step_Nm, 0.05);
  EXPECT_TRUE(std::isfinite(bench.state(0).temperature_used_C));
  EXPECT_TRUE(std::isnan(bench.state(0).temperature_margin_C));
  bench.run(1.0);
  bench.inject(0, {});
  const ChangeOver back = change_over(bench, true);
  EXPECT_LE(back.torque_step_Nm, 0.05);
  EXPECT_TRUE(std::isfinite(bench.state(0).temperature_margin_C));
  EXPECT_EQ(bench.fault(0), Fault::kNone);
}

TEST_P(TemperatureLoss, MakesNoMoreTorqueStepInMotionThanTheMotionItself) {
  BenchJoint slow = joint();
  slow.loop.controller.motion.velocity_rad_s = 0.5;
  JointBench bench({slow});
  bench.bring_to_hold(0);
  bench.run(1.0);
  bench.inject(0, {InjectedFault::kTemperatureLost});
  bench.run(0.2);
  bench.move(0, 3.0);  // takes 6 s
  const ChangeOver away = change_over(bench, false);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_LE(away.torque_step_Nm, std::max(0.05, away.usual_step_Nm));
  bench.run(0.5);
  bench.inject(0, {});
  const ChangeOver back = change_over(bench, true);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_LE(back.torque_step_Nm, std::max(0.05, 1.1 * back.usual_step_Nm));
  bench.run(8.0);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 3.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Temperatures, TemperatureLoss, ::testing::Values(-10.0, 5.0, 25.0, 45.0));

/// The joint derates from 70 degC on. Its limit is at 80 degC.
BenchJoint joint_at(double temperature_C) {
  BenchJoint joint = demo_joint();
  joint.drive.plant.thermal.resistance_C_W = 0.0;
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  return joint;
}

/// Periods that 2 rad take at the joint's full speed. A fault ends them.
std::int64_t periods_of_a_move(JointBench& bench) {
  EXPECT_EQ(bench.move(0, 2.0), Reason::kAccepted);
  return bench.step_until([&] { return bench.mode(0) != Mode::kTracking; }, 60000);
}

TEST(Derating, MakesMotionsSlowerTheHotterTheJointAndNoneFails) {
  std::int64_t before = 0;
  double limit_Nm = 1e9;
  for (const double temperature_C : {20.0, 69.0, 71.0, 75.0, 78.0, 79.0, 79.9}) {
    JointBench bench({joint_at(temperature_C)});
    bench.bring_to_hold(0);
    const double now_Nm = bench.state(0).torque_limit_Nm;
    const std::int64_t lasts = periods_of_a_move(bench);
    EXPECT_EQ(bench.mode(0), Mode::kHolding) << temperature_C;
    EXPECT_NEAR(bench.state(0).joint_position_rad, 2.0, 1e-3) << temperature_C;
    EXPECT_EQ(bench.has_notice(0, Notice::kDerated), temperature_C > 70.0) << temperature_C;
    EXPECT_NEAR(bench.state(0).temperature_margin_C, 80.0 - temperature_C, 0.2) << temperature_C;
    EXPECT_GE(lasts, before - 1) << temperature_C;
    EXPECT_LE(now_Nm, limit_Nm) << temperature_C;
    EXPECT_NEAR(now_Nm, 34.0 * std::min(1.0, (80.0 - temperature_C) / 10.0), 1.0) << temperature_C;
    before = lasts;
    limit_Nm = now_Nm;
  }
  EXPECT_GT(before, 600) << "at full torque 0.4 s";
}

// A weight of 8 N.m does not fall because of heat, and the joint brakes with all of its torque.
TEST(Derating, LeavesTheTorqueThatHoldsAndBrakes) {
  BenchJoint joint = joint_at(79.5);
  joint.loop.controller.motion.velocity_rad_s = 1.0;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  bench.drive(0).simulated().set_load_torque_Nm(8.0);
  bench.run(2.0);
  EXPECT_LT(bench.state(0).torque_limit_Nm, 3.0);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 0.0, 1e-3);
  (void)periods_of_a_move(bench);
  EXPECT_EQ(bench.mode(0), Mode::kHolding);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 2.0, 1e-3);
}

// Moves to and fro without rest at 70 degC ambient, with a gear that warms within seconds. No derating if `derating_C` is at the limit.
Fault fault_of_hot_work(double derating_C) {
  BenchJoint joint = joint_at(70.0);
  joint.drive.plant.thermal = {1.2, 6.0, 0.1};
  joint.loop.limits.derating_C = derating_C;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  for (int k = 0; k < 20000 && bench.fault(0) == Fault::kNone; ++k) {
    if (bench.mode(0) == Mode::kHolding)
      EXPECT_EQ(bench.move(0, bench.state(0).joint_position_rad > 0.0 ? -1.0 : 1.0), Reason::kAccepted);
    else
      bench.step();
  }
  return bench.fault(0);
}

TEST(Derating, KeepsAJointBelowTheLimitAtWhichItFaultedBefore) {
  EXPECT_EQ(fault_of_hot_work(79.999), Fault::kTemperatureLimit);
  EXPECT_EQ(fault_of_hot_work(70.0), Fault::kNone);
}

}  // namespace
}  // namespace strainwave::testing
