// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of [joint.can] with protocol = "odrive". Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave {

/// Reads the drive, and sets the values that depend on it: encoder, delay and motor of the controller, and the
/// texts of the drive's errors. Throws InputError.
odrive::DriveConfig read_odrive(TomlSection& section, int node_id, double period_s, JointConfig& joint);

}  // namespace strainwave
