// The keys of [joint.can.motor] that all protocols share: what motor and supply leave for torque at speed.
// Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/motor_limits.h"

namespace strainwave {

/// Of a motor with this torque constant at its own shaft, behind `gear_ratio`. Without supply_V and
/// resistance_ohm the peak torque at the joint is the only limit. Throws InputError when only one of the two
/// is given.
MotorLimits read_motor_limits(TomlSection& section, double torque_constant_Nm_A, double gear_ratio,
                              double peak_joint_torque_Nm);

}  // namespace strainwave
