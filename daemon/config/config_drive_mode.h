// SPDX-License-Identifier: BSD-3-Clause
// The key drive_mode of [joint.can]: which loop the drive closes by itself. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Reads drive_mode, and sets it in the joint's controller. A drive that closes its own loop does so at the motor, and goes on against
/// what pushes it: throws InputError with an encoder on the link, and with on_overload = "hold_load".
DriveMode read_drive_mode(TomlSection& section, JointConfig& joint);

}  // namespace strainwave
