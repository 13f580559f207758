// SPDX-License-Identifier: BSD-3-Clause
// Random numbers for patients, the same for the same seed.
#pragma once

#include <random>

namespace strainwave::testing {

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// A factor of 1 / high to 1 / low or of low to high, each with probability 0.5.
  double off(double low, double high) {
    const double factor = between(low, high);
    return between(0.0, 1.0) < 0.5 ? factor : 1.0 / factor;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace strainwave::testing
