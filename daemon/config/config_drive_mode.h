// SPDX-License-Identifier: BSD-3-Clause
// Reads the key drive_mode of [joint.can]: which loop the drive closes by itself. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Reads drive_mode into the joint's controller. A drive that closes its own loop does so at the motor, and works against any push. So
/// such a mode with an encoder on the link, or with on_overload = "hold_load", throws InputError.
DriveMode read_drive_mode(TomlSection& section, JointConfig& joint);

}  // namespace strainwave
