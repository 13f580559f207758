// SPDX-License-Identifier: BSD-3-Clause
// `strainwaved --commission JOINT`: moves one joint of a configuration to learn what it is. It needs no gain table. Not real-time.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "commission/commissioning.h"
#include "daemon/config/config.h"
#include "strainwave/exit_status.h"

namespace strainwave {

/// What of `config` commissioning needs of joint `index`; where it stands is left open. Throws InputError for a joint that cannot be
/// commissioned: rigid, homed, measured at its link, or with a drive that closes its own loop.
CommissioningConfig commissioning_config(const DaemonConfig& config, std::size_t index);

/// Runs all steps, a line before and after each on `out`, and writes commission.json into `directory` after each. kDone: all is as
/// configured; kRefused: a step failed, and its line says why; kInterrupted. Throws InputError before anything moves.
ExitStatus commission_joint(const DaemonConfig& config, const std::filesystem::path& config_file,
                            const std::string& joint, const std::filesystem::path& directory,
                            std::ostream& out);

}  // namespace strainwave
