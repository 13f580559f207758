// SPDX-License-Identifier: BSD-3-Clause
// The gain table that a joint starts with: read from its file and judged as one that is loaded over LCM. The start and
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
  std::string verdict;              ///< the certificate's smallest margin, and which torque limit holds
  std::vector<std::string> doubts;  ///< about the joint's limits with this table
};

/// Nothing when the configuration names none. Throws InputError that names where it does: a file that cannot be read, is no table,
/// may be written by others than the configuration may, or is refused for the joint.
std::optional<InitialTable> read_initial_table(const JointConfig& joint);

}  // namespace strainwave
