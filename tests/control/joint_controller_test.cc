// SPDX-License-Identifier: BSD-3-Clause
// The controller on the joint for which its table is designed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/units.h"
#include "tests/control/controlled_joint.h"

namespace strainwave::testing {
namespace {

TEST(JointController, EndsWithinACountWithoutOvershootAndRestsQuietlyHoweverColdItIs) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> target(-1.5, 1.5);
  std::uniform_real_distribution<double> temperature(-10.0, 40.0);
  for (int trial = 0; trial < 60; ++trial) {
    ControlledJoint loop;
    loop.temperature_C = temperature(random);
    const double target_rad = target(random);
    loop.controller().set_target(target_rad);
    double overshoot_rad = 0.0;
    for (int k = 0; k < 2000; ++k) {
      loop.step();
      overshoot_rad =
          std::max(overshoot_rad, std::copysign(1.0, target_rad) * (loop.position_rad() - target_rad));
    }
    EXPECT_LE(overshoot_rad, 1e-3) << target_rad << " at " << loop.temperature_C;
    EXPECT_LE(std::abs(loop.position_rad() - target_rad), 1.6 * kCount_rad)
        << target_rad << " at " << loop.temperature_C;
    int sign_changes = 0;
    double last_sign = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double now = sign(loop.step().output.torque_Nm);
      if (now != 0.0 && last_sign != 0.0 && now != last_sign) ++sign_changes;
      if (now != 0.0) last_sign = now;
    }
    EXPECT_EQ(sign_changes, 0) << target_rad << " at " << loop.temperature_C;
  }
}

TEST(JointController, RunsATableOfAJointWithoutFriction) {
  GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  for (int i = 0; i < table.friction.rule_count; ++i) {
    FrictionParameters& friction = table.friction.rules[static_cast<std::size_t>(i)].friction;
    friction.static_Nm = 0.0;
    friction.coulomb_Nm = 0.0;
  }
  ControlledJoint loop;
  loop.controller().load(table);
  loop.controller().start(loop.position_rad());
  loop.controller().set_target(0.1);
  for (int k = 0; k < 2000; ++k) {
    const JointStep step = loop.step();
    ASSERT_TRUE(std::isfinite(step.output.torque_Nm) && std::isfinite(step.output.feedforward_torque_Nm))
        << k;
  }
}

TEST(JointController, BringsALoadStepBackToWithinAMilliradian) {
  for (const double load_Nm : {-8.0, 3.0, 8.0}) {
    ControlledJoint loop;
    loop.controller().set_target(0.3);
    loop.run(2.0);
    loop.load_torque_Nm = load_Nm;
    loop.run(3.0);
    EXPECT_LE(std::abs(loop.position_rad() - 0.3), 1e-3) << load_Nm;
  }
}

// With every encoder, and with a flickering reading, the controller sends no torque to a joint that has no order yet.
TEST(JointController, LeavesAJointAloneThatStandsUntilItIsOrderedOn) {
  for (const double counts : {65536.0, 131072.0, 320000.0})
    for (const double start_counts : {-0.4, 0.1, 0.49}) {
      const double count_rad = 2.0 * std::numbers::pi / counts;
      JointPlantConfig coarse = realistic_plant();
      coarse.encoder.counts_per_joint_revolution = counts;
      coarse.initial_position_rad = start_counts * count_rad;
      JointControllerConfig config = realistic_config();
      config.encoder_resolution_rad = count_rad;
      ControlledJoint loop(coarse, config);
      loop.noise_rad = 0.3 * count_rad;
      const auto step = [&] {
        loop.noise_rad = -loop.noise_rad;
        return loop.step().output.torque_Nm;
      };
      for (int k = 0; k < 1000; ++k)
        ASSERT_EQ(step(), 0.0) << counts << " counts, " << start_counts << ", " << k;
      loop.controller().set_target(0.01);
      for (int k = 0; k < 2000; ++k) step();
      EXPECT_NEAR(loop.position_rad(), 0.01, 2.5 * count_rad) << counts << " counts, " << start_counts;
    }
}

TEST(JointController, BeginsWithTheMotionAndTheLoadThatItFinds) {
  JointController controller(realistic_config());
  controller.load(read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json"));
  JointMeasurement measurement;
  measurement.temperature_C = 20.0;
  measurement.temperature_valid = true;
  controller.start(0.0, 0.0, 7.0);
  EXPECT_NEAR(controller.step(measurement).output.torque_Nm, 7.0, 1e-9);

  JointPlant plant(realistic_plant());
  plant.set_ambient_temperature(20.0);
  while (plant.state().velocity_rad_s < 3.6) plant.step(20.0);
  const double position_rad = plant.measured_position_rad();
  plant.clear_pending_torque();
  plant.step(0.0);
  const double velocity_rad_s = (plant.measured_position_rad() - position_rad) / 0.001;
  controller.start(plant.measured_position_rad(), velocity_rad_s, 0.0);
  double last_Nm = 0.0;
  int reversals = 0;
  for (int k = 0; k < 1000; ++k) {
    measurement.joint_position_rad = plant.measured_position_rad();
    const JointStep step = controller.step(measurement);
    if (k == 0) {
      EXPECT_EQ(step.reference.velocity_rad_s, velocity_rad_s);
      EXPECT_LT(step.output.torque_Nm, 0.0);
    }
    if (plant.state().velocity_rad_s > 0.2 && step.output.torque_Nm * last_Nm < 0.0) ++reversals;
    last_Nm = step.output.torque_Nm;
    plant.step(step.output.torque_Nm, 0.0);
  }
  EXPECT_LE(reversals, 1) << "where it comes to rest";
  EXPECT_EQ(plant.state().velocity_rad_s, 0.0);
}

/// RMS following error over a move to 1 rad and back at 1 rad/s.
double rms_error_rad(ControlledJoint& loop) {
  double squares = 0.0;
  for (const double target_rad : {1.0, 0.0}) {
    loop.controller().set_target(target_rad, 1.0);
    for (int k = 0; k < 1500; ++k) {
      const double position_rad = loop.position_rad();
      squares += std::pow(loop.step().reference.position_rad - position_rad, 2);
    }
  }
  return std::sqrt(squares / 3000.0);
}

TEST(JointController, LearnsFrictionThatIsNotTheTables) {
  for (const double scale : {0.5, 2.0}) {
    JointPlantConfig plant = realistic_plant();
    for (FrictionParameters* part : {&plant.joint.friction.asymptote, &plant.joint.friction.amplitude})
      *part = {scale * part->static_Nm, scale * part->coulomb_Nm, scale * part->viscous_Nms_rad};
    JointControllerConfig config = realistic_config();
    config.motion = {1.0, 20.0, 20.0};
    ControlledJoint loop(plant, config);
    const double first_rad = rms_error_rad(loop);
    for (int motion = 0; motion < 3; ++motion) rms_error_rad(loop);
    EXPECT_LT(rms_error_rad(loop), 0.7 * first_rad) << scale;
    EXPECT_NEAR(loop.controller().friction().factor(), scale, 0.2 * scale);
  }
}

}  // namespace
}  // namespace strainwave::testing
