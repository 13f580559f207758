// SPDX-License-Identifier: BSD-3-Clause
// Derives findings from features. The first finding is the cause that explains the unusual features best. Not real-time.
//
//   misfit(cause) = min over lambda of  sum over features of  rho((x - lambda a) / s)
//                   where each feature in cause.explains counts at most kPriceOfExplaining;
//                   + kPriceOfExplaining if lambda is free
//   rho(z) = 4 ln(1 + z^2 / 4), the tail of Student's distribution: one side effect that no cause predicts does not outweigh the rest
//
// A cause is a finding if its misfit is at least kWorthNaming below that of no cause. Its features are then removed, and the search repeats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "doctor/features.h"

namespace strainwave {

struct Finding {
  std::string_view cause;
  std::vector<std::string> evidence;  ///< measured and expected values
  std::string_view remedy;
  double probability = 0.0;  ///< among the known causes
};

struct Diagnosis {
  std::vector<Finding> findings;        ///< the best explanation first
  std::vector<std::string> not_judged;  ///< what is not judged, and what it needs
};

Diagnosis diagnose(const Evidence& evidence);

}  // namespace strainwave
