// SPDX-License-Identifier: BSD-3-Clause
// Friction and load of a joint that the control law has learned. Plain data. Real-time safe. Joint side, SI.
//
//   friction of temperature rule i    F_i' = (1 + s_i) F_i           F_i: the table's
//   factor at a temperature           sum_i w_i (1 + s_i) F_i / sum_i w_i F_i       w_i: weights of the rules
#pragma once

#include <array>
#include <cstddef>

#include "control/friction/fuzzy_friction.h"

namespace strainwave {

/// Range of a scale s_i: a tenth of the table's friction to four times the table's.
inline constexpr double kLeastScale = -0.9;
inline constexpr double kMostScale = 3.0;

struct LearnedFriction {
  std::array<double, kMaxTemperatureRules> scale{};  ///< s_i, in [kLeastScale, kMostScale]
  double load_Nm = 0.0;                              ///< in addition to gravity and the configured load

  bool operator==(const LearnedFriction&) const = default;
};

/// The factor by which friction at the temperature of `weights` differs from the table's; 1 without rules. F_i is Coulomb friction.
inline double friction_factor(const LearnedFriction& learned, const FuzzyFriction& table,
                              const TemperatureWeights& weights) noexcept {
  double learned_Nm = 0.0;
  double table_Nm = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i) {
    const double rule_Nm = weights.weight[i] * table.rules[i].friction.coulomb_Nm;
    learned_Nm += (1.0 + learned.scale[i]) * rule_Nm;
    table_Nm += rule_Nm;
  }
  return table_Nm > 0.0 ? learned_Nm / table_Nm : 1.0;
}

}  // namespace strainwave
