// SPDX-License-Identifier: BSD-3-Clause
// Proof of one cell of a table's box in rational numbers (docs/certificate.md). Not real-time.
#pragma once

#include "design/exact/exact_certificate.h"

namespace strainwave {

/// Proves that V = x' P x of `cell` in `table` falls on every joint of the cell under each gain. Counts the inequalities in `report`,
/// which must be certified so far, and enters a failure there. Throws std::domain_error if the period is too long for exponential().
void prove_cell(const GainTable& table, const BoxCell& cell, ExactReport& report);

}  // namespace strainwave
