#include "daemon/config/config_motor.h"

namespace strainwave {

MotorLimits read_motor_limits(TomlSection& section, double torque_constant_Nm_A, double gear_ratio,
                              double peak_joint_torque_Nm) {
  constexpr Range kPositive{1e-9, 1e9};
  const double back_emf_Vs_rad = section.number_or("back_emf_Vs_rad", torque_constant_Nm_A, {0.0, 1e6});
  MotorData motor;
  motor.peak_torque_Nm = peak_joint_torque_Nm;
  motor.torque_constant_Nm_A = torque_constant_Nm_A * gear_ratio;
  motor.back_emf_Vs_rad = back_emf_Vs_rad * gear_ratio;
  if (section.has("supply_V") != section.has("resistance_ohm"))
    section.fail("supply_V", "supply_V and resistance_ohm, or neither, are allowed");
  if (section.has("supply_V")) {
    motor.supply_V = section.number("supply_V", kPositive);
    motor.resistance_ohm = section.number("resistance_ohm", kPositive);
  }
  return MotorLimits::from_motor(motor);
}

}  // namespace strainwave
