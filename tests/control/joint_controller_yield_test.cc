// SPDX-License-Identifier: BSD-3-Clause
// A controller that yields, and the load that shows, on the simulated joint.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/control/controlled_joint.h"

namespace strainwave::testing {
namespace {

constexpr double kLoad_Nm = 6.0;

/// A joint that has held its load and now yields to more. Where it held.
double yield_to_a_push(ControlledJoint& loop) {
  loop.load_torque_Nm = kLoad_Nm;
  loop.run(1.0);
  const double held_rad = loop.position_rad();
  loop.load_torque_Nm = 20.0;
  loop.controller().yield(kLoad_Nm);
  return held_rad;
}

TEST(JointControllerYield, LeavesTheJointToWhatPushesItAndHoldsItsLoad) {
  ControlledJoint loop;
  const double from_rad = yield_to_a_push(loop);
  for (int k = 0; k < 60; ++k) {
    const JointStep step = loop.step();
    ASSERT_EQ(step.phase, MotionPhase::kYielding) << k;
    ASSERT_EQ(step.output.torque_Nm, kLoad_Nm) << k;
    ASSERT_NEAR(step.ordered_reference.position_rad, loop.position_rad(), 0.01) << k;
  }
  EXPECT_LT(loop.position_rad(), from_rad - 0.01) << "it went where it was pushed";
}

TEST(JointControllerYield, HoldsWhereItComesToRestOnceItIsLetGo) {
  ControlledJoint loop;
  const double from_rad = yield_to_a_push(loop);
  loop.run(0.05);
  loop.load_torque_Nm = kLoad_Nm;
  loop.run(1.0);
  EXPECT_FALSE(loop.controller().yields());
  loop.run(1.0);
  const double held_rad = loop.position_rad();
  EXPECT_LT(held_rad, from_rad);
  loop.load_torque_Nm = 9.0;
  loop.run(0.5);
  EXPECT_NEAR(loop.position_rad(), held_rad, 2e-3) << "it holds again";
}

TEST(JointControllerYield, TheLoadShowsAsWhatTheFeedbackAsksFor) {
  JointControllerConfig config = realistic_config();
  config.motion = {6.0, 150.0, 150.0};
  JointController controller(config);
  controller.load(read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json"));
  JointPlant plant(realistic_plant());
  controller.start(plant.measured_position_rad());
  controller.set_target(2.0, 1.0);
  JointStep step;
  for (int k = 0; k < 1500; ++k) {
    plant.set_ambient_temperature(20.0);
    JointMeasurement measurement;
    measurement.joint_position_rad = plant.measured_position_rad();
    measurement.temperature_C = 20.0;
    measurement.temperature_valid = true;
    step = controller.step(measurement);
    if (k == 999) {
      EXPECT_NEAR(step.load_Nm, 0.0, 2.0);
    }
    plant.step(step.output.torque_Nm, k < 1000 ? 0.0 : 10.0);
  }
  EXPECT_NEAR(step.load_Nm, 10.0, 3.0);
}

}  // namespace
}  // namespace strainwave::testing
