// SPDX-License-Identifier: BSD-3-Clause
// When and at what temperature a joint learned its friction, and which factor calls for a notice. Real-time safe.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace strainwave {

struct FrictionHistory {
  double learned_C = std::numeric_limits<double>::quiet_NaN();  ///< temperature at which it last learned
  std::optional<std::int64_t> learned_ns{};                     ///< when, monotonic; nothing: never

  void learned_now(double temperature_C, std::int64_t now_ns) noexcept {
    learned_C = temperature_C;
    learned_ns = now_ns;
  }
  /// Time since the joint last learned, s; -1: never.
  double age_s(std::int64_t now_ns) const noexcept {
    return learned_ns ? 1e-9 * static_cast<double>(now_ns - *learned_ns) : -1.0;
  }
};

/// Friction of twice the table's must give a notice even if a quarter of it is not learned yet: 2 * 3/4, and the inverse.
inline constexpr double kMostFrictionFactor = 2.0 * 3.0 / 4.0;

constexpr bool differs_from_table(double friction_factor) noexcept {
  return friction_factor > kMostFrictionFactor || friction_factor < 1.0 / kMostFrictionFactor;
}

}  // namespace strainwave
