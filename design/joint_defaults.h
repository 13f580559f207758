// SPDX-License-Identifier: BSD-3-Clause
// Values that gains and verify take from the catalogue if the user does not give them. Offline.
#pragma once

#include <optional>
#include <string>

#include "base/units.h"
#include "control/joint/gear_catalogue.h"
#include "design/friction/friction_file.h"

namespace strainwave {

/// The model of the catalogue's actuator if it has `gear`, else the gear's own name.
std::string usual_model(const Gear& gear);

/// The Stribeck curve of the catalogue's friction, joint side: 20 RPM at the motor, exponent 2 (data/README.md).
inline StribeckShape source_stribeck_shape(double gear_ratio) {
  return {joint_velocity_rad_s_from_motor_rpm(20.0, gear_ratio), 2.0};
}

/// Friction of a joint with `gear`: the fitted friction of the catalogue's actuator if `joint_model` is that
/// actuator. Otherwise it is the estimate of control/joint/friction_estimate.h, and `note` says so.
struct CatalogueFriction {
  FrictionRules rules;
  std::string note;    ///< for the table; empty: not an estimate
  std::string origin;  ///< for the user
};
CatalogueFriction catalogue_friction(const Gear& gear, const std::string& joint_model);

/// A one-line warning if Coulomb friction at 20 degC is above ten times or below a tenth of the catalogue's for `gear`. Otherwise, and without a
/// gear, it is empty. Wrong units or a wrong side of the gear give larger factors. The catalogue's estimates are within half to twice.
std::string friction_doubt(const FuzzyFriction& given, const Gear* gear);

/// The torque weight with which the search for gains on a spring begins. It is `actuators` for the gear of
/// the catalogue's actuator, else a weight that gives stiff gains for every gear of the catalogue.
double usual_torque_weight(const Gear& gear, double actuators);

/// Inertia in kg m^2 on the motor's side of the spring, at the joint, and its origin.
struct MotorInertia {
  double at_joint_kgm2 = 0.0;
  std::string origin;
};
/// (rotor + wave generator) ratio^2 for a rotor of `rotor_kgm2` at its own shaft. Without a rotor, it is that of the catalogue's actuator.
/// Throws InputError, which names `place` and what is missing, if `gear` is null or `joint_model` is not the actuator with that gear.
MotorInertia usual_motor_inertia(const std::string& place, const Gear* gear, const std::string& joint_model,
                                 const std::optional<double>& rotor_kgm2);

}  // namespace strainwave
