// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a key of a file may have. Not real-time.
#pragma once

#include <algorithm>
#include <string>

#include "base/printable.h"

namespace strainwave {

struct Range {
  double min;
  double max;

  /// False of NaN.
  constexpr bool holds(double value) const noexcept { return value >= min && value <= max; }
  /// Of a list of numbers.
  template <typename Values>
  bool holds_all(const Values& values) const noexcept {
    return std::ranges::all_of(values, [this](double value) { return holds(value); });
  }
  std::string text() const { return "from " + number_text(min) + " to " + number_text(max); }
};
/// Of a quantity that is above zero and has no other bounds.
inline constexpr Range kPositive{1e-9, 1e9};
/// The same of one that may be zero.
inline constexpr Range kNotNegative{0.0, 1e9};

}  // namespace strainwave
