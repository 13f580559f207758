// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction.h"

#include <algorithm>

namespace strainwave {

double VelocityMemberships::zero_weight(double velocity_rad_s) const noexcept {
  return ZeroVelocityWeight(*this).at(velocity_rad_s);
}

TemperatureWeights FuzzyFriction::weights(double temperature_C) const noexcept {
  return TemperatureMemberships(*this).weights(temperature_C);
}

FrictionParameters FuzzyFriction::blend(const TemperatureWeights& weights) const noexcept {
  FrictionParameters blended;
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i) {
    blended.static_Nm += weights.weight[i] * rules[i].friction.static_Nm;
    blended.coulomb_Nm += weights.weight[i] * rules[i].friction.coulomb_Nm;
    blended.viscous_Nms_rad += weights.weight[i] * rules[i].friction.viscous_Nms_rad;
  }
  return blended;
}

double FuzzyFriction::largest_viscous_Nms_rad() const noexcept {
  double largest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_count); ++i)
    largest = std::max(largest, rules[i].friction.viscous_Nms_rad);
  return largest;
}

}  // namespace strainwave
