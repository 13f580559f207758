// SPDX-License-Identifier: BSD-3-Clause
// Recorded states as CSV: the message's fields under their own names (an array as name_0, name_1, ...), of the weights only
// those that some state uses, and behind mode and fault their words. Numbers read back to the same bits. Not real-time.
#pragma once

#include <strainwave/state_v1.hpp>
#include <string>

namespace strainwave {

/// Weights of `state` that mean something.
int weights_in_use(const state_v1& state);

/// Each column with a comma before it; `weights`: the most that any row uses.
std::string state_csv_columns(int weights);
/// Each value with a comma before it. A weight beyond those of the state is empty.
std::string state_csv_values(const state_v1& state, int weights);

}  // namespace strainwave
