// SPDX-License-Identifier: BSD-3-Clause
// From features to findings: the cause that explains most of what is unusual is named first. Not real-time.
//
//   misfit(cause) = min over lambda of  sum over features of  rho((x - lambda a) / s)
//                   of which those that it explains by any amount count at most kPriceOfExplaining;
//                   + kPriceOfExplaining where there is a lambda
//   rho(z) = 4 ln(1 + z^2 / 4), the tail of Student's distribution: a knock-on effect that no cause predicts does not outweigh all else
//
// Where that is better than no cause by kWorthNaming it is a finding; what it explains is taken away, and the rest is looked at again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "doctor/features.h"

namespace strainwave {

struct Finding {
  std::string_view cause;
  std::vector<std::string> evidence;  ///< what was measured, and what was expected
  std::string_view remedy;
  double probability = 0.0;  ///< among the causes that are known here
};

struct Diagnosis {
  std::vector<Finding> findings;        ///< the likeliest first
  std::vector<std::string> not_judged;  ///< what, and what it needs
};

Diagnosis diagnose(const Evidence& evidence);

}  // namespace strainwave
