// SPDX-License-Identifier: BSD-3-Clause
// One cell of a table's box in rational numbers: docs/certificate.md. Not real-time.
#pragma once

#include "design/exact/exact_certificate.h"

namespace strainwave {

/// V = x' P x of `cell`, a cell of `table`, falls on every joint of it, under each gain of both controllers. Adds its inequalities to `report`,
/// which must be certified so far, and the place of a failure. Throws std::domain_error where the period is too long for exponential().
void prove_cell(const GainTable& table, const BoxCell& cell, ExactReport& report);

}  // namespace strainwave
