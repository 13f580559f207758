// SPDX-License-Identifier: BSD-3-Clause
// The keys of [joint.can.motor] and [joint.gpio.motor] that all drives share: what motor and supply leave for torque at speed.
// Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/joint/motor_limits.h"

namespace strainwave {

/// At the motor's own shaft.
struct MotorConstants {
  double torque_constant_Nm_A = 0.0;
  double back_emf_Vs_rad = 0.0;
  /// The same seen from the joint; supply, resistance and peak torque are left open.
  MotorData at_joint(double gear_ratio) const;
};

/// torque_constant_Nm_A, and back_emf_Vs_rad, which equals it unless it is given.
MotorConstants read_motor_constants(TomlSection& section);

/// Without supply_V and resistance_ohm the peak torque at the joint is the only limit. Throws InputError when only one of the
/// two is given.
MotorLimits read_motor_limits(TomlSection& section, const MotorConstants& motor, double gear_ratio,
                              double peak_joint_torque_Nm);

}  // namespace strainwave
