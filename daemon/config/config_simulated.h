// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of [joint.simulated]: a simulated joint in place of a drive. Not real-time.
#pragma once

#include <filesystem>

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_homing.h"

namespace strainwave {

/// Reads the section and sets the values that depend on the driver: the drive, and the encoder, delay and motor data of the
/// controller. Files of profiles are relative to `folder`. Returns the inputs for homing. Throws InputError.
HomingInputs read_simulated_driver(TomlSection& section, double period_s, const std::filesystem::path& folder,
                                   JointConfig& joint);

}  // namespace strainwave
