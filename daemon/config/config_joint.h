// SPDX-License-Identifier: BSD-3-Clause
// Reads one [[joint]] of the configuration. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_can.h"

namespace strainwave {

/// Reads the section and all sections below it. Paths are relative to `folder`; a drive on a bus is added to its
/// bus in `can`. Throws InputError.
JointConfig read_joint(TomlSection& section, double period_s, const std::filesystem::path& folder,
                       CanConfig& can, ConfigUse use);

/// Reads a name that is valid in a channel's name. With an empty `fallback` the key is required. Throws InputError.
std::string read_name(TomlSection& section, std::string_view key, std::string fallback);

}  // namespace strainwave
