// SPDX-License-Identifier: BSD-3-Clause
// The fall of a quadratic form over one step of a loop that is known within bounds. Not real-time.
#pragma once

#include "design/exact/rational_matrix.h"

namespace strainwave {

/// Returns true only if it is proved that
///   allowed - factor (H + D)' P (H + D)  >  0     for every D with |D| <= X, entry by entry; H = loop.value, X = loop.radius
/// P symmetric; factor > 0. With w_i the rows of P H, R = X' |P| X and any l_ij, s_i > 0:
///   D' P H + H' P D  <=  sum_ij X_ij (l_ij w_i' w_i + e_j e_j' / l_ij),      D' P D  <=  diag_i (sum_j R_ij s_j / s_i)
/// l and s are short numbers near the best ones. A poor choice may refuse a true inequality, but never accepts a false one.
bool falls(const RationalMatrix& allowed, const RationalMatrix& P, const Enclosure& loop,
           const mpq_class& factor);

/// A number of few binary digits within 1.6 % of `value`, or 1 if `value` is not positive and finite.
mpq_class short_number_near(double value);

}  // namespace strainwave
