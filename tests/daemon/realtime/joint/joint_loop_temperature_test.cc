// SPDX-License-Identifier: BSD-3-Clause
// Loss and return of the temperature signal while the joint is controlled. Virtual time.
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
    joint.loop.temperature.recovery_s = 0.3;
    joint.drive.ambient = TemperatureProfile::constant(GetParam());
    return joint;
  }

  /// Runs until the gains in use are `wanted`, and looks at the torque around that cycle.
  ChangeOver change_over(JointBench& bench, GainsInUse wanted) {
    ChangeOver result{0.0, 0.0};
    double previous_Nm = bench.state(0).torque_commanded_Nm;
    bool changed = false;
    for (int after = 0; after < 100; after += changed ? 1 : 0) {
      bench.step();
      const double step_Nm = std::abs(bench.state(0).torque_commanded_Nm - previous_Nm);
      previous_Nm = bench.state(0).torque_commanded_Nm;
      const bool now = !changed && bench.state(0).gains_in_use == static_cast<int>(wanted);
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

TEST_P(TemperatureLoss, ChangesTheGainsWithoutATorqueStepAtRestAndBackAgain) {
  JointBench bench({joint()});
  bench.bring_to_hold(0);
  bench.drive(0).simulated().set_load_torque_Nm(5.0);
  bench.run(2.0);
  bench.inject(0, {InjectedFault::kTemperatureLost});
  const ChangeOver away = change_over(bench, GainsInUse::kFallback);
  EXPECT_LE(away.torque_step_Nm, 0.05);
  EXPECT_TRUE(bench.has_notice(0, Notice::kFallbackGains));
  bench.run(1.0);
  bench.inject(0, {});
  const ChangeOver back = change_over(bench, GainsInUse::kPrimary);
  EXPECT_LE(back.torque_step_Nm, 0.05);
  EXPECT_FALSE(bench.has_notice(0, Notice::kFallbackGains));
  EXPECT_EQ(bench.fault(0), Fault::kNone);
}

TEST_P(TemperatureLoss, ChangesTheGainsInMotionWithNoMoreTorqueStepThanTheMotionItself) {
  BenchJoint slow = joint();
  slow.loop.controller.motion.velocity_rad_s = 0.5;
  JointBench bench({slow});
  bench.bring_to_hold(0);
  bench.run(1.0);
  bench.inject(0, {InjectedFault::kTemperatureLost});
  bench.run(0.2);
  bench.move(0, 3.0);  // 6 s
  const ChangeOver away = change_over(bench, GainsInUse::kFallback);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_LE(away.torque_step_Nm, std::max(0.05, away.usual_step_Nm));
  bench.run(0.5);
  bench.inject(0, {});
  const ChangeOver back = change_over(bench, GainsInUse::kPrimary);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_LE(back.torque_step_Nm, std::max(0.05, 1.1 * back.usual_step_Nm));
  bench.run(8.0);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 3.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Temperatures, TemperatureLoss, ::testing::Values(-10.0, 5.0, 25.0, 45.0));

}  // namespace
}  // namespace strainwave::testing
