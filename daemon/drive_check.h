// SPDX-License-Identifier: BSD-3-Clause
// Checks the drives of a configuration before the loop: is another daemon using them, would start-up accept them? Not real-time.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <vector>

#include "daemon/assembly.h"
#include "daemon/config/config.h"
#include "daemon/instance_lock.h"

namespace strainwave {

/// Opens a bus. Throws InputError when start-up would refuse a drive on it.
using BusOpener = std::function<std::unique_ptr<Fieldbus>(const BusConfig&)>;

/// Locks every drive for this process. Throws InputError when another daemon has one.
std::vector<InstanceLock> lock_drives(const DaemonConfig& config);

/// Runs the complete start-up of the drives on buses, but enables none, and closes the buses. Writes findings and
/// errors to `out`; returns whether start-up would accept all drives. Throws InputError when another daemon has one
/// of them.
bool check_drives(const DaemonConfig& config, std::ostream& out, const BusOpener& open = assemble_bus);

/// Lists every digital line of the joints with its level and its holder; touches no output. Returns whether each can be used.
bool check_lines(const DaemonConfig& config, std::ostream& out);

/// Runs start-up of every CiA 402 drive against an electronic data sheet; touches no hardware. Writes missing objects to `out`.
/// Returns whether there is such a drive and start-up would accept all of them.
bool check_data_sheet(const DaemonConfig& config, const std::filesystem::path& file, std::ostream& out);

}  // namespace strainwave
