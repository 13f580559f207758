// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a key of a file may have. Not real-time.
#pragma once

#include <string>

#include "base/printable.h"

namespace strainwave {

struct Range {
  double min;
  double max;

  /// False of NaN.
  constexpr bool holds(double value) const noexcept { return value >= min && value <= max; }
  std::string text() const { return "from " + number_text(min) + " to " + number_text(max); }
};
/// Of a quantity that is above zero and has no other bounds.
inline constexpr Range kPositive{1e-9, 1e9};

}  // namespace strainwave
