// SPDX-License-Identifier: BSD-3-Clause
// A drive on a CAN bus, of any protocol, from its configuration, and a bus of several drives. Not real-time.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/can/cia402/cia402_config.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave {

using CanDrive = std::variant<cia402::DriveConfig, odrive::DriveConfig>;

/// Returns the nodes in the order of `drives`. Does not access hardware.
std::vector<std::unique_ptr<CanNode>> make_nodes(const std::vector<CanDrive>& drives);

/// Checks the interface and sets up every drive. Throws InputError with every drive that failed.
std::unique_ptr<Fieldbus> open_can_bus(const CanBusConfig& config, const std::vector<CanDrive>& drives);

}  // namespace strainwave
