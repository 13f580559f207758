// SPDX-License-Identifier: BSD-3-Clause
// What many results are summed up by. Not real-time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace strainwave {

/// The value below which `fraction`, in [0, 1], of the values are; 0 of none.
inline double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
}

/// Of values > 0; 0 of none.
inline double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 0.0 : std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace strainwave
