// SPDX-License-Identifier: BSD-3-Clause
// The gain table to and from its message. The conversion copies and nothing else: whether the result is sound is
// find_defect()'s and certify()'s question. Not real-time.
#pragma once

#include <strainwave/gain_table_v1.hpp>

#include "control/table/gain_table.h"

namespace strainwave {

/// Every field of `table`; the envelope's fields (utime, session, sender, sequence, signature) stay zero.
gain_table_v1 to_message(const GainTable& table);

/// Every field of `message` that belongs to the table, bit for bit.
GainTable to_gain_table(const gain_table_v1& message);

}  // namespace strainwave
