// SPDX-License-Identifier: BSD-3-Clause
// Finds numbers of a drive and its motor that are allowed but contradict each other. The warnings name the value that is likely meant.
// Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave {

/// Checks [joint.can], already read into `drive`: too few counts in a motor turn, an unusual unit of velocity, a foreign torque unit.
void doubt_drive(const TomlSection& section, const JointConfig& joint, const cia402::DriveConfig& drive);

/// Checks [joint.can.motor] in `motor`. Warns of a supply that cannot reach the joint's speed limit by
///   U >= k_E * gear_ratio * speed_limit_rad_s
/// and a torque constant with which the rated current gives far more than the joint's torque limit.
void doubt_motor(TomlSection& motor, const JointConfig& joint, const cia402::DriveConfig& drive);

}  // namespace strainwave
