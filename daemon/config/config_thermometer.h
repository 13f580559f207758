// SPDX-License-Identifier: BSD-3-Clause
// Reads [joint.thermometer] of the configuration: a temperature sensor that Linux shows as a file. Not real-time.
#pragma once

#include <filesystem>

#include "base/toml_section.h"
#include "drivers/temperature_file.h"

namespace strainwave {

/// Reads the section; its file is relative to `folder`. Throws InputError.
TemperatureFileConfig read_thermometer(TomlSection section, const std::filesystem::path& folder);

}  // namespace strainwave
