// SPDX-License-Identifier: BSD-3-Clause
// Recorded states as CSV: each column has the name of its field (an array as name_0, name_1, ...). Of the weights, only those
// in use get columns. Mode and fault are followed by their words. Numbers read back to the same bits. Not real-time.
#pragma once

#include <strainwave/state_v1.hpp>
#include <string>

namespace strainwave {

/// Number of weights in use in `state`.
int weights_in_use(const state_v1& state);

/// Each column with a comma before it. `weights`: the largest number that any row uses.
std::string state_csv_columns(int weights);
/// Each value with a comma before it. Weights that the state does not use are empty.
std::string state_csv_values(const state_v1& state, int weights);

}  // namespace strainwave
