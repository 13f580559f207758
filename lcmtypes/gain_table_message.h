// SPDX-License-Identifier: BSD-3-Clause
// Converts the gain table to and from its message. The conversion only copies; find_defect() and certify() check the
// result. Not real-time.
#pragma once

#include <strainwave/gain_table_v1.hpp>

#include "control/table/gain_table.h"

namespace strainwave {

/// Copies every field of `table`; the envelope's fields (utime, session, sender, sequence, signature) stay zero.
gain_table_v1 to_message(const GainTable& table);

/// Copies every field of `message` that belongs to the table, bit for bit.
GainTable to_gain_table(const gain_table_v1& message);

}  // namespace strainwave
