// SPDX-License-Identifier: BSD-3-Clause
// Gain tables for people. Offline.
#pragma once

#include <string>

#include "control/table/gain_table.h"

namespace strainwave {

/// In a line, where the spring's stiffness may change: at any instant, or within a cell. Nothing of a rigid joint.
std::string stiffness_text(const CertifiedBox& box);

/// What the table is for, its rules, gains, and where it came from.
std::string description(const GainTable& table);

}  // namespace strainwave
