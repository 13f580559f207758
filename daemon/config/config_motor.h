// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of [joint.can.motor] and [joint.gpio.motor] that all drives share. They give the torque that motor and supply
// can deliver at each speed. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/joint/motor_limits.h"

namespace strainwave {

/// Constants at the motor's own shaft.
struct MotorConstants {
  double torque_constant_Nm_A = 0.0;
  double back_emf_Vs_rad = 0.0;
  /// Returns the constants at the joint side; supply, resistance and peak torque keep their defaults.
  MotorData at_joint(double gear_ratio) const;
};

/// Reads torque_constant_Nm_A, and back_emf_Vs_rad, which equals it by default.
MotorConstants read_motor_constants(TomlSection& section);

/// Without supply_V and resistance_ohm the peak torque at the joint is the only limit. Throws InputError when only one of the
/// two is given.
MotorLimits read_motor_limits(TomlSection& section, const MotorConstants& motor, double gear_ratio,
                              double peak_joint_torque_Nm);

}  // namespace strainwave
