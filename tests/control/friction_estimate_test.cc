// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/friction_estimate.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "control/joint/joint_catalogue.h"

namespace strainwave {
namespace {

const Gear& gear_named(const std::string& name) {
  return *find_gear(name);
}

/// Friction of the RHS-17-6006, joint side.
FrictionParameters known(double temperature_C) {
  return catalogue_joint().friction_at(temperature_C, 50.0);
}

/// Friction torque of a turning motor, motor side.
double motor_running_Nm(const FrictionParameters& friction, double motor_rpm, double ratio) {
  const double joint_rad_s = joint_velocity_rad_s_from_motor_rpm(motor_rpm, ratio);
  return (friction.coulomb_Nm + friction.viscous_Nms_rad * joint_rad_s) / ratio;
}

TEST(FrictionEstimate, IsThatOfTheKnownGearForItself) {
  for (const double temperature_C : {-10.0, 3.0, 40.0}) {
    const FrictionParameters own = known(temperature_C);
    const FrictionParameters estimate = estimate_friction(gear_named("csf-17-50"), own);
    EXPECT_NEAR(estimate.static_Nm, own.static_Nm, 1e-12 * own.static_Nm);
    EXPECT_NEAR(estimate.coulomb_Nm, own.coulomb_Nm, 1e-12 * own.coulomb_Nm);
    EXPECT_NEAR(estimate.viscous_Nms_rad, own.viscous_Nms_rad, 1e-12 * own.viscous_Nms_rad);
  }
}

TEST(FrictionEstimate, HasTheCataloguesTorquesWhereItStatesThem) {
  for (const Gear& gear : gear_catalogue()) {
    const FrictionParameters estimate = estimate_friction(gear, known(20.0));
    if (gear.motor_starting_torque_Nm) {
      EXPECT_NEAR(estimate.static_Nm / gear.ratio, *gear.motor_starting_torque_Nm, 1e-9) << gear.name;
    }
    if (gear.motor_running_torque_Nm) {
      EXPECT_NEAR(motor_running_Nm(estimate, 2000.0, gear.ratio), *gear.motor_running_torque_Nm, 1e-9)
          << gear.name;
    }
  }
}

TEST(FrictionEstimate, IsFrictionOfEveryGearAndGrowsWithSizeAndCold) {
  for (const std::string ratio : {"50", "100"}) {
    FrictionParameters smaller;
    for (const char* size : {"14", "17", "20", "25", "32"}) {
      const Gear& gear = gear_named("csf-" + std::string(size) + "-" + ratio);
      SCOPED_TRACE(gear.name);
      const FrictionParameters cold = estimate_friction(gear, known(-10.0));
      const FrictionParameters warm = estimate_friction(gear, known(40.0));
      EXPECT_GT(warm.viscous_Nms_rad, smaller.viscous_Nms_rad);
      EXPECT_GT(warm.coulomb_Nm, smaller.coulomb_Nm);
      EXPECT_GT(warm.static_Nm, warm.coulomb_Nm);
      EXPECT_GT(cold.static_Nm, warm.static_Nm);
      EXPECT_GT(cold.coulomb_Nm, warm.coulomb_Nm);
      EXPECT_GT(cold.viscous_Nms_rad, warm.viscous_Nms_rad);
      EXPECT_LT(cold.static_Nm, gear.repeated_peak_torque_Nm) << "it turns at -10 degC";
      smaller = warm;
    }
  }
}

TEST(FrictionEstimate, OfALawIsThatOfItsParameters) {
  const Gear& gear = gear_named("csf-25-100");
  const FrictionLaw law{{{40.0, 30.0, 8.0}, {100.0, 90.0, 20.0}, 5.0, 12.0}, {0.04, 2.0}};
  const FrictionLaw same = estimate_friction(gear, law);
  EXPECT_NEAR(same.over_temperature.at(15.0).coulomb_Nm,
              estimate_friction(gear, law.over_temperature.at(15.0)).coulomb_Nm, 1e-9);
  EXPECT_DOUBLE_EQ(same.stribeck.velocity_rad_s, 0.02) << "the same speed of the motor";
}

}  // namespace
}  // namespace strainwave
