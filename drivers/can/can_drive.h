// SPDX-License-Identifier: BSD-3-Clause
// A drive on a CAN bus by its configuration, of whatever protocol, and the bus of several. Not real-time.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/can/cia402/cia402_config.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave {

using CanDrive = std::variant<cia402::DriveConfig, odrive::DriveConfig>;

/// In the order of `drives`. Touches no hardware.
std::vector<std::unique_ptr<CanNode>> make_nodes(const std::vector<CanDrive>& drives);

/// Looks at the interface and sets every drive up. Throws InputError that names every drive that refused.
std::unique_ptr<Fieldbus> open_can_bus(const CanBusConfig& config, const std::vector<CanDrive>& drives);

}  // namespace strainwave
