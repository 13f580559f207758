// SPDX-License-Identifier: BSD-3-Clause
// Root of a rising function by the Illinois variant of false position. The bracket always holds the root, and
// convergence is superlinear. Offline.
#pragma once

#include <cmath>

namespace strainwave {

/// x in [low, high] with f(x) = 0, for f rising, f(low) <= 0 <= f(high). Ends when |f| <= `tolerance` or the
/// bracket cannot shrink.
template <typename Function>
double find_rising_root(const Function& f, double low, double high, double tolerance) {
  double f_low = f(low);
  double f_high = f(high);
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    if (std::abs(f_low) <= tolerance) return low;
    if (std::abs(f_high) <= tolerance) return high;
    const double x = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(x > low && x < high)) return 0.5 * (low + high);
    const double value = f(x);
    if (std::abs(value) <= tolerance) return x;
    if (value > 0.0) {
      high = x;
      f_high = value;
      if (side == 1) f_low *= 0.5;
      side = 1;
    } else {
      low = x;
      f_low = value;
      if (side == -1) f_high *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace strainwave
