// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/friction_estimate.h"

#include <cmath>

#include "base/units.h"
#include "control/joint/joint_catalogue.h"

namespace strainwave {

namespace {

// Conditions of the running and starting torques in the catalogue.
constexpr double kStated_C = 20.0;
constexpr double kStatedMotor_rad_s = 2000.0 * kRadPerSecondPerRpm;

struct Factors {
  double coulomb = 0.0;
  double viscous = 0.0;
};

// Factors on the motor side.
Factors factors_of(const Gear& gear, const Gear& known, const FrictionParameters& known_friction) {
  const double volume = std::pow(gear.size / known.size, 3.0);
  Factors factors{volume, volume};
  if (gear.motor_starting_torque_Nm)
    factors.coulomb = *gear.motor_starting_torque_Nm / known_friction.static_Nm;
  if (gear.motor_running_torque_Nm)
    factors.viscous = (*gear.motor_running_torque_Nm - factors.coulomb * known_friction.coulomb_Nm) /
                      (known_friction.viscous_Nms_rad * kStatedMotor_rad_s);
  return factors;
}

double ratio_to_known(const Gear& gear) {
  return gear.ratio / find_gear(catalogue_joint().gear)->ratio;
}

}  // namespace

FrictionParameters estimate_friction(const Gear& gear, const FrictionParameters& rhs17) {
  const CatalogueJoint& known = catalogue_joint();
  const Factors factors = factors_of(gear, *find_gear(known.gear), known.friction_at(kStated_C, 1.0));
  const double ratio = ratio_to_known(gear);
  return {ratio * factors.coulomb * rhs17.static_Nm, ratio * factors.coulomb * rhs17.coulomb_Nm,
          ratio * ratio * factors.viscous * rhs17.viscous_Nms_rad};
}

FrictionLaw estimate_friction(const Gear& gear, FrictionLaw rhs17) {
  ExponentialTemperatureLaw& law = rhs17.over_temperature;
  law.asymptote = estimate_friction(gear, law.asymptote);
  law.amplitude = estimate_friction(gear, law.amplitude);
  rhs17.stribeck.velocity_rad_s /= ratio_to_known(gear);
  return rhs17;
}

}  // namespace strainwave
