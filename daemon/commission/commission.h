// SPDX-License-Identifier: BSD-3-Clause
// `strainwaved --commission JOINT`: moves one joint of a configuration to measure its properties. Needs no gain table. Not real-time.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "commission/commissioning.h"
#include "daemon/config/config.h"
#include "strainwave/exit_status.h"

namespace strainwave {

/// The settings in `config` that commissioning needs for joint `index`, except its start position. Throws InputError for an unsuitable
/// joint, such as one that is rigid, must be homed, is measured at its link, or has a drive that closes its own loop.
CommissioningConfig commissioning_config(const DaemonConfig& config, std::size_t index);

/// Runs all steps, prints a line before and after each to `out`, and writes commission.json into `directory` after each. Returns kDone;
/// kRefused if a step failed, whose line says why; or kInterrupted. Throws InputError only before any motion.
ExitStatus commission_joint(const DaemonConfig& config, const std::filesystem::path& config_file,
                            const std::string& joint, const std::filesystem::path& directory,
                            std::ostream& out);

}  // namespace strainwave
