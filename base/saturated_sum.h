// SPDX-License-Identifier: BSD-3-Clause
// Sums of counts from outside, such as messages. They saturate at the largest or smallest number instead of wrapping. Real-time safe.
#pragma once

#include <cstdint>
#include <limits>

namespace strainwave {

inline std::int64_t saturated_sum(std::int64_t a, std::int64_t b) noexcept {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return b > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

}  // namespace strainwave
