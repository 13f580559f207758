// SPDX-License-Identifier: BSD-3-Clause
// Gain tables for people. Offline.
#pragma once

#include <string>

#include "control/table/gain_table.h"

namespace strainwave {

/// What the table is for, its rules, gains, and where it came from.
std::string description(const GainTable& table);

}  // namespace strainwave
