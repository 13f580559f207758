// SPDX-License-Identifier: BSD-3-Clause
// Gain tables as text for the user. Offline.
#pragma once

#include <string>

#include "control/table/gain_table.h"

namespace strainwave {

/// One line that says whether the spring's stiffness may change at any instant or only within a cell. Empty for a rigid joint.
std::string stiffness_text(const CertifiedBox& box);

/// Purpose, rules, gains and origin of the table.
std::string description(const GainTable& table);

}  // namespace strainwave
