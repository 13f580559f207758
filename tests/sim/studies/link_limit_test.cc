// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/link_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

JointPlantConfig plant(double link_inertia_kgm2, double delay_periods) {
  JointPlantConfig config = realistic_plant();
  Transmission gear;
  gear.link_inertia_kgm2 = link_inertia_kgm2;
  gear.spring = TorsionSpring::linear(1e4);
  gear.damping_Nms_rad = 2.0;
  config.effects.transmission = gear;
  config.delay.periods = delay_periods;
  return config;
}

double pi2(double temperature_C, double link_inertia_kgm2, double step_rad, double delay_periods = 0.0) {
  return find_link_limit(link_limit_config(plant(link_inertia_kgm2, delay_periods), temperature_C, step_rad))
      .pi2;
}

// The expected values come from an independently written program.
TEST(LinkLimit, IsTheOneFoundIndependently) {
  const struct {
    double temperature_C, link_kgm2, pi2[4];
  } table[] = {{-5, 0.03, {4.32, 7.12, 20.48, 86.5}},  {-5, 0.1, {6.54, 9.33, 25.56, 95.5}},
               {-5, 0.3, {10.15, 12.97, 36.1, 119.9}}, {-5, 1.0, {17.2, 20.8, 60.7, 192}},
               {30, 0.1, {6.50, 9.19, 24.6, 88.6}},    {30, 0.3, {10.1, 12.8, 34.8, 112.2}}};
  for (const auto& row : table) {
    double step_rad = 0.001;
    for (const double expected : row.pi2) {
      EXPECT_NEAR(pi2(row.temperature_C, row.link_kgm2, step_rad), expected, 0.01 * expected)
          << row.temperature_C << " degC, " << row.link_kgm2 << " kg.m2, " << step_rad << " rad";
      step_rad *= 10.0;
    }
  }
}

TEST(LinkLimit, CostsOneSampleMorePerPeriodOfDelay) {
  EXPECT_NEAR(pi2(-5, 0.1, 0.01, 2.0) - pi2(-5, 0.1, 0.01, 0.0), 2.0, 1e-6);
}

TEST(LinkLimit, DoesNotDependOnTheDirection) {
  EXPECT_NEAR(pi2(-5, 0.1, -0.01), pi2(-5, 0.1, 0.01), 1e-6);
}

// The linear programme's torque brings the link of the simulated plant to its target: its model agrees with the plant.
TEST(LinkLimit, IsReachedByItsOwnTorqueInThePlant) {
  JointPlantConfig config = plant(0.1, 0.0);
  config.joint.stribeck.velocity_rad_s = 1e-6;  // the programme models Coulomb friction only
  config.joint.friction.asymptote.static_Nm = config.joint.friction.asymptote.coulomb_Nm;
  config.joint.friction.amplitude.static_Nm = config.joint.friction.amplitude.coulomb_Nm;
  config.substeps = 50;
  const LinkLimit limit = find_link_limit(link_limit_config(config, -5.0, 0.1));
  JointPlant joint(config);
  double sum = 0.0;
  for (std::size_t k = 0; k < limit.torque_Nm.size(); ++k) {
    joint.set_ambient_temperature(-5.0);
    sum += std::abs(0.1 - joint.link_state().position_rad) / 0.1;
    joint.step(limit.torque_Nm[k]);
  }
  EXPECT_NEAR(sum, limit.pi2, 0.01 * limit.pi2);
  EXPECT_NEAR(joint.link_state().position_rad, 0.1, 1e-3);
}

TEST(LinkLimit, CountsFewerSamplesAboveTwoCounts) {
  const LinkLimit limit = find_link_limit(link_limit_config(plant(0.1, 0.0), -5.0, 0.01));
  EXPECT_LE(limit.counted_pi2, limit.pi2);
  EXPECT_GT(limit.counted_pi2, 0.9 * limit.pi2);
}

TEST(LinkLimit, SettlesNoEarlierIntoANarrowerBand) {
  const LinkLimitConfig config = link_limit_config(plant(0.1, 0.0), -5.0, 0.01);
  const double wide_s = least_settling_time_s(config, 1e-3);
  const double narrow_s = least_settling_time_s(config, 40e-6);
  EXPECT_LT(wide_s, narrow_s);
  EXPECT_LT(narrow_s, 0.04);
}

TEST(LinkLimit, RefusesAJointThatCannotMove) {
  JointPlantConfig weak = plant(0.1, 0.0);
  weak.motor.peak_torque_Nm = 1.0;
  EXPECT_THROW(link_limit_config(weak, -5.0, 0.01), InputError);
  EXPECT_THROW(link_limit_config(realistic_plant(), -5.0, 0.01), InputError) << "there is no link";
}

}  // namespace
}  // namespace strainwave
