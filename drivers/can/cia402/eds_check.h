// SPDX-License-Identifier: BSD-3-Clause
// Whether a drive could be started, from its electronic data sheet alone: start-up itself is run against a drive that has what
// the data sheet has and refuses what it refuses, in virtual time. So nothing that start-up reads, writes or maps is listed a
// second time here. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "drivers/can/canopen/eds_file.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave::cia402 {

/// What start-up would say, and what could not be checked: values that the data sheet does not have, entries that are unclear in it,
/// limits that exclude what start-up writes. Throws InputError naming the file, the object and why start-up would be refused.
std::vector<std::string> check_data_sheet(const canopen::EdsFile& eds, const DriveConfig& config);

}  // namespace strainwave::cia402
