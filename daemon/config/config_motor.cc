#include "daemon/config/config_motor.h"

#include <limits>

namespace strainwave {

MotorLimits read_motor_limits(TomlSection& section, double torque_constant_Nm_A, double gear_ratio,
                              double peak_joint_torque_Nm) {
  constexpr Range kPositive{1e-9, 1e9};
  const double back_emf_Vs_rad = section.number_or("back_emf_Vs_rad", torque_constant_Nm_A, {0.0, 1e6});
  MotorLimits limits;
  limits.peak_torque_Nm = peak_joint_torque_Nm;
  limits.stall_torque_Nm = std::numeric_limits<double>::infinity();
  if (section.has("supply_V") != section.has("resistance_ohm"))
    section.fail("supply_V", "supply_V and resistance_ohm, or neither, are allowed");
  if (section.has("supply_V")) {
    const double supply_V = section.number("supply_V", kPositive);
    const double resistance_ohm = section.number("resistance_ohm", kPositive);
    const double joint_Nm_A = torque_constant_Nm_A * gear_ratio;
    limits.stall_torque_Nm = joint_Nm_A * supply_V / resistance_ohm;
    limits.torque_per_speed_Nms_rad = joint_Nm_A * back_emf_Vs_rad * gear_ratio / resistance_ohm;
  }
  return limits;
}

}  // namespace strainwave
