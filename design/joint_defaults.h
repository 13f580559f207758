// SPDX-License-Identifier: BSD-3-Clause
// What gains and verify take from the catalogue where it is not given. Offline.
#pragma once

#include <optional>
#include <string>

#include "base/units.h"
#include "control/joint/gear_catalogue.h"
#include "design/friction/friction_file.h"

namespace strainwave {

/// The model of the catalogue's actuator with `gear`, else the gear's own name.
std::string usual_model(const Gear& gear);

/// The Stribeck curve of the catalogue's friction, joint side: 20 RPM at the motor, exponent 2 (data/README.md).
inline StribeckShape source_stribeck_shape(double gear_ratio) {
  return {joint_velocity_rad_s_from_motor_rpm(20.0, gear_ratio), 2.0};
}

/// Friction of a joint with `gear`: what is fitted to the catalogue's actuator where `joint_model` is it, else the estimate of
/// control/joint/friction_estimate.h, which `note` says.
struct CatalogueFriction {
  FrictionRules rules;
  std::string note;    ///< for the table; empty: no estimate
  std::string origin;  ///< for the user
};
CatalogueFriction catalogue_friction(const Gear& gear, const std::string& joint_model);

/// A warning in one line if Coulomb friction at 20 degC is beyond ten times or a tenth of what the catalogue has of `gear`; else, and without a
/// gear, empty. Wrong units and the wrong side of the gear are farther off, the estimates of the catalogue are within twice or half.
std::string friction_doubt(const FuzzyFriction& given, const Gear* gear);

/// The cost's weight of the torque at which the search for gains on a spring begins: that of the catalogue's actuator, else one that is
/// stiff for each gear of the catalogue.
double usual_torque_weight(const Gear& gear, double actuators);

/// Inertia in kg m^2 on the motor's side of the spring, at the joint, and where it is from.
struct MotorInertia {
  double at_joint_kgm2 = 0.0;
  std::string origin;
};
/// Of a motor whose rotor has `rotor_kgm2` at its own shaft: (rotor + wave generator) ratio^2; without one of the catalogue's actuator. Throws
/// InputError that names `place` and asks for the motor where `gear` is null or `joint_model` is no actuator with it.
MotorInertia usual_motor_inertia(const std::string& place, const Gear* gear, const std::string& joint_model,
                                 const std::optional<double>& rotor_kgm2);

}  // namespace strainwave
