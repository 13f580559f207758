// SPDX-License-Identifier: BSD-3-Clause
// Memberships of temperature with which falling rules give a falling curve. They are a better start than free memberships. Offline.
//
//   mu_i = exp(-((T - c_i)/s_i)^2),   r_i(T) = (T - c_i)/s_i^2
//   r_i >= r_(i+1) at both ends of the range  =>  mu_(i+1)/mu_i rises with T  =>  the blend of rules that fall never rises
//
// This is because r is linear in T, and weights that move to later, lower rules cannot raise the blend (monotone likelihood
// ratio). The fit is a nonlinear least-squares problem in c and log s with these inequalities. Sequential quadratic
// programming (NLopt's SLSQP; Kraft 1988) solves it from many starts, with the consequents projected out (linear_fit.h).
#pragma once

#include <cstdint>

#include "design/friction/estimation.h"

namespace strainwave {

/// The best fit with ordered memberships over [min_C, max_C]. Its curve never rises there if
/// `problem.physical`. The same seed gives the same result. rules >= 2.
FuzzyFit fit_ordered_memberships(const FitProblem& problem, int rules, const MembershipBox& box, double min_C,
                                 double max_C, std::uint64_t seed);

}  // namespace strainwave
