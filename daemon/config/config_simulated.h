// SPDX-License-Identifier: BSD-3-Clause
// The keys of [joint.simulated]: the simulated joint behind the drivers' seam. Not real-time.
#pragma once

#include <filesystem>

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_homing.h"

namespace strainwave {

/// Reads the section and sets what depends on the driver: the drive, and the encoder, delay and motor data of the
/// controller; files of profiles are relative to `folder`. What the joint can be homed by. Throws InputError.
HomingInputs read_simulated_driver(TomlSection& section, double period_s, const std::filesystem::path& folder,
                                   JointConfig& joint);

}  // namespace strainwave
