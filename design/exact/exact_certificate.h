// SPDX-License-Identifier: BSD-3-Clause
// The second checker of a gain table, which proves the statement of docs/certificate.md in rational numbers. It shares no code
// with the checker in control/table except the table itself, so that an error in either one shows. Not real-time: up to a minute.
#pragma once

#include <string>

#include "control/table/gain_table.h"

namespace strainwave {

struct ExactReport {
  bool certified = false;
  int inequalities = 0;
  std::string
      refusal;  ///< the inequality that fails, or the part of the box without a cell; empty if certified
};

/// Checks the inequalities of every cell of the box, and that the cells cover it. find_defect() must find nothing in `table`.
ExactReport certify_exactly(const GainTable& table);

}  // namespace strainwave
