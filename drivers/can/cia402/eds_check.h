// SPDX-License-Identifier: BSD-3-Clause
// Checks from its electronic data sheet alone whether a drive could be started. It runs the real start-up in
// virtual time against a simulated drive with the entries and access rights of the data sheet. So no second
// list of the objects of start-up is needed. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "drivers/can/canopen/eds_file.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave::cia402 {

/// Returns the messages of start-up and the points that could not be checked: missing values, unclear entries, limits that
/// exclude written values. Throws InputError with the file, the object and the reason why start-up would be refused.
std::vector<std::string> check_data_sheet(const canopen::EdsFile& eds, const DriveConfig& config);

}  // namespace strainwave::cia402
