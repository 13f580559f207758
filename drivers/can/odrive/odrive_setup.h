// SPDX-License-Identifier: BSD-3-Clause
// Bringing an ODrive axis to where the loop can use it: version, watchdog, rates of its messages; it stays
// idle. Blocking; not real-time. Source: ODrive documentation, "CAN Protocol", firmware 0.6.10.
#pragma once

#include <string>
#include <vector>

#include "drivers/can/can_port.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave::odrive {

/// Checks that an ODrive with firmware 0.6 answers, and that its watchdog is on and short enough; asks only.
/// Returns lines for the log. Throws InputError naming joint, node, what was found and what is allowed.
std::vector<std::string> check_axis(CanPort& port, const DriveConfig& config);

/// Listens for a while: throws InputError when a message that the loop needs is missing or too rare, naming
/// the ODrive setting that mends it.
void verify_axis(CanPort& port, const DriveConfig& config);

/// No torque, idle.
void release_axis(CanPort& port, const DriveConfig& config);

}  // namespace strainwave::odrive
