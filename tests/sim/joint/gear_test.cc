// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "sim/joint/delay_line.h"
#include "sim/joint/joint_effects.h"
#include "sim/joint/joint_plant.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

TEST(KinematicError, HasTheSlopeOfItsValue) {
  const KinematicError error{{4e-4, 2e-4}, {0.3, -1.0}};
  for (double turn_rad = 0.0; turn_rad < 7.0; turn_rad += 0.1)
    EXPECT_NEAR(error.slope(turn_rad),
                (error.value_rad(turn_rad + 1e-5) - error.value_rad(turn_rad - 1e-5)) / 2e-5, 1e-11);
}

TEST(FreeFreeFrequency, IsTheCataloguesFor17And50) {
  const TorsionSpring spring = find_gear("csf-17-50")->spring;
  EXPECT_NEAR(free_free_frequency_rad_s(0.089, 0.089, spring.stiffness_1_Nm_rad) / (2.0 * M_PI), 68.0, 0.5);
  EXPECT_NEAR(free_free_frequency_rad_s(0.089, 0.267, spring.stiffness_3_Nm_rad) / (2.0 * M_PI), 70.0, 0.5);
}

TEST(DelayLine, DelaysByFractionsOfAPeriodAndNeverReorders) {
  DelayLine line({1.25, 0.0, 1});
  line.push(0.0, 7.0);
  EXPECT_EQ(line.at(1.2), 0.0);
  EXPECT_EQ(line.next_due(), 1.25);
  EXPECT_EQ(line.at(1.25), 7.0);

  DelayLine jittery({1.0, 3.0, 42});
  DelayLine same({1.0, 3.0, 42});
  double last = 0.0;
  bool late = false;
  for (int k = 0; k < 200; ++k) {
    jittery.push(k, k + 1.0);
    same.push(k, k + 1.0);
    const double acting = jittery.at(k);
    EXPECT_EQ(acting, same.at(k)) << "the seed decides";
    EXPECT_GE(acting, last) << "no command overtakes an earlier one";
    EXPECT_LE(acting, static_cast<double>(k)) << "nor comes before its delay";
    late = late || acting < k - 1.0;
    last = acting;
  }
  EXPECT_TRUE(late);
}

TEST(JointPlant, ActsOnHalfACommandWhenTheDelayEndsWithinThePeriod) {
  JointPlantConfig config = ideal_plant();
  config.joint.friction = {};
  config.joint.friction.decay_C = 1.0;
  config.delay.periods = 0.5;
  JointPlant plant(config);
  plant.set_ambient_temperature(20.0);
  plant.step(10.0);
  EXPECT_NEAR(plant.state().velocity_rad_s, 10.0 / config.joint.inertia_kgm2 * 0.5e-3, 1e-12);
}

TEST(JointPlant, CarriesGravityWithItsSpringFromTheStart) {
  JointPlantConfig config = flexible_plant();
  config.effects.gravity = {2.0, 0.0};
  config.initial_position_rad = 1.0;
  JointPlant plant(config);
  plant.set_ambient_temperature(20.0);
  const double link_rad = plant.link_state().position_rad;
  EXPECT_NEAR(plant.state().position_rad - link_rad,
              config.effects.transmission->spring.angle_rad(2.0 * std::sin(link_rad)), 1e-12);
  for (int k = 0; k < 500; ++k) plant.step(0.0);
  EXPECT_NEAR(plant.link_state().position_rad, link_rad, 1e-12)
      << "static friction holds what the spring passes on";
}

TEST(JointPlant, ReportsTheSideItsFeedbackSitsOn) {
  JointPlantConfig config = flexible_plant();
  config.link_encoder.counts_per_joint_revolution = 1e6;
  JointPlant motor_side(config);
  config.feedback = EncoderSide::kLink;
  JointPlant link_side(config);
  for (int k = 0; k < 30; ++k) {
    for (JointPlant* plant : {&motor_side, &link_side}) {
      plant->set_ambient_temperature(20.0);
      plant->step(20.0);
    }
    EXPECT_NEAR(motor_side.measured_position_rad(), motor_side.state().position_rad, 1e-5);
    EXPECT_NEAR(link_side.measured_position_rad(), link_side.link_state().position_rad, 3.2e-6);
  }
  EXPECT_GT(std::abs(motor_side.measured_position_rad() - link_side.measured_position_rad()), 1e-4);
}

}  // namespace
}  // namespace strainwave
