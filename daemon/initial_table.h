// SPDX-License-Identifier: BSD-3-Clause
// Reads the gain table that a joint starts with, and judges it like a table that is loaded over LCM. The start and
// `strainwaved --check` both call this. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/table/gain_table.h"
#include "daemon/config/config.h"

namespace strainwave {

struct InitialTable {
  GainTable table;
  std::string verdict;              ///< the certificate's smallest margin, and the torque limit in force
  std::vector<std::string> doubts;  ///< about the joint's limits with this table
};

/// Returns nothing when the configuration names no table. Throws InputError for a file that cannot be read, is no table, can be
/// written by other users (writers_allowed()), or is refused for the joint. The error names the place in the configuration.
std::optional<InitialTable> read_initial_table(const JointConfig& joint);

}  // namespace strainwave
