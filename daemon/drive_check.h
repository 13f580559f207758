// SPDX-License-Identifier: BSD-3-Clause
// The drives of a configuration, before the loop: whose they are, and whether start-up would accept them. Not real-time.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <vector>

#include "daemon/assembly.h"
#include "daemon/config/config.h"
#include "daemon/instance_lock.h"

namespace strainwave {

/// Throws InputError when a drive on the bus would be refused.
using BusOpener = std::function<std::unique_ptr<Fieldbus>(const BusConfig&)>;

/// Takes every drive for this process. Throws InputError when another daemon has one.
std::vector<InstanceLock> lock_drives(const DaemonConfig& config);

/// Does to the drives on buses all that start-up does, enables none, and leaves them. Writes what it found or
/// what is wrong to `out`; returns whether start-up would accept all. Throws InputError when another daemon
/// has one of them.
bool check_drives(const DaemonConfig& config, std::ostream& out, const BusOpener& open = assemble_bus);

/// Shows every digital line of the joints, its level and who holds it, without touching outputs. Returns whether each can be used.
bool check_lines(const DaemonConfig& config, std::ostream& out);

/// Runs start-up of every joint that has such a drive against the drive's electronic data sheet; touches no hardware. Returns
/// whether all would be accepted; what is missing is in the text.
bool check_data_sheet(const DaemonConfig& config, const std::filesystem::path& file, std::ostream& out);

}  // namespace strainwave
