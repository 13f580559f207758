// SPDX-License-Identifier: BSD-3-Clause
// Statistics that summarise many results. Not real-time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace strainwave {

/// The value below which the share `fraction`, in [0, 1], of the values lies; 0 without values.
inline double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
}

/// The geometric mean of values > 0; 0 without values.
inline double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 0.0 : std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace strainwave
