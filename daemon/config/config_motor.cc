// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_motor.h"

namespace strainwave {

MotorData MotorConstants::at_joint(double gear_ratio) const {
  MotorData motor;
  motor.torque_constant_Nm_A = torque_constant_Nm_A * gear_ratio;
  motor.back_emf_Vs_rad = back_emf_Vs_rad * gear_ratio;
  return motor;
}

MotorConstants read_motor_constants(TomlSection& section) {
  const double torque_constant_Nm_A = section.number("torque_constant_Nm_A", kPositive);
  return {torque_constant_Nm_A, section.number_or("back_emf_Vs_rad", torque_constant_Nm_A, {0.0, 1e6})};
}

MotorLimits read_motor_limits(TomlSection& section, const MotorConstants& motor, double gear_ratio,
                              double peak_joint_torque_Nm) {
  MotorData data = motor.at_joint(gear_ratio);
  data.peak_torque_Nm = peak_joint_torque_Nm;
  if (section.has("supply_V") != section.has("resistance_ohm"))
    section.fail("supply_V", "supply_V and resistance_ohm belong together: give both, or neither");
  if (section.has("supply_V")) {
    data.supply_V = section.number("supply_V", kPositive);
    data.resistance_ohm = section.number("resistance_ohm", kPositive);
  }
  return MotorLimits::from_motor(data);
}

}  // namespace strainwave
