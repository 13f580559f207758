// SPDX-License-Identifier: BSD-3-Clause
// Estimation of friction over temperature by EPGS: the nonlinear parameters are searched, the linear ones
// follow (variable projection, linear_fit.h). Offline. Source: Zhao (2006), chapter 4.
#pragma once

#include "design/friction/epgs.h"
#include "design/friction/friction_fit.h"

namespace strainwave {

/// Limits of the centres and widths of memberships.
struct MembershipBox {
  double center_min_C = -15.0;
  double center_max_C = 45.0;
  double width_min_C = 1.0;
  double width_max_C = 15.0;
};

/// Options with which the fits of the catalogue reach their best known costs: about 0.8 s on one core for the
/// fuzzy rules.
EpgsOptions fuzzy_search_options();
EpgsOptions exponential_search_options();

template <typename Fit>
struct Estimate {
  Fit fit;
  EpgsResult search;
};

/// Searches 2 * rules variables: centres and widths. Rules with equal centres are allowed.
Estimate<FuzzyFit> estimate_fuzzy(const FitProblem& problem, int rules, const MembershipBox& box,
                                  const EpgsOptions& options);

/// Searches decay_C in [low, high]; the other six parameters are linear, and T0 is redundant.
Estimate<ExponentialFit> estimate_exponential(const FitProblem& problem, double low_C, double high_C,
                                              const EpgsOptions& options);

/// The cost that estimate_fuzzy minimises, over [centres, widths]; for comparisons with other optimisers.
GradientCost fuzzy_cost(const FitProblem& problem);
GradientCost exponential_cost(const FitProblem& problem);

}  // namespace strainwave
