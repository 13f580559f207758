// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a drive and its motor that contradict each other, each by itself allowed: the configuration warns with the value that is
// likely meant. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave {

/// Of [joint.can], already read into `drive`: counts of a turn of the motor, a unit of torque that the maker does not use.
void doubt_drive(const TomlSection& section, const JointConfig& joint, const cia402::DriveConfig& drive);

/// Of [joint.can.motor] in `motor`: a supply that cannot reach the joint's speed limit by
///   U >= k_E * gear_ratio * speed_limit_rad_s
/// and a torque constant with which the rated current gives far more than the joint's torque limit.
void doubt_motor(TomlSection& motor, const JointConfig& joint, const cia402::DriveConfig& drive);

}  // namespace strainwave
