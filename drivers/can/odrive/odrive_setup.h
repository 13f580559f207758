// SPDX-License-Identifier: BSD-3-Clause
// Prepares an ODrive axis for the loop: checks version, watchdog and rates of its messages; the axis stays
// idle. Blocking; not real-time. Source: ODrive documentation, "CAN Protocol", firmware 0.6.10.
#pragma once

#include <string>
#include <vector>

#include "drivers/can/can_port.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave::odrive {

/// Checks that an ODrive with firmware 0.6 answers and that its watchdog is on and short enough. It only
/// reads. Returns lines for the log. Throws InputError with joint, node, value and what is allowed.
std::vector<std::string> check_axis(CanPort& port, const DriveConfig& config);

/// Listens for 0.5 s. Throws InputError when a message that the loop needs is missing or too rare, with the
/// ODrive setting that fixes it.
void verify_axis(CanPort& port, const DriveConfig& config);

/// Orders zero torque (in torque mode), then idle.
void release_axis(CanPort& port, const DriveConfig& config);

}  // namespace strainwave::odrive
