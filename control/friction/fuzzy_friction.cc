// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

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

double FuzzyFriction::torque_Nm(const FrictionParameters& friction, double velocity_rad_s) const noexcept {
  const double zero_weight = velocity.zero_weight(velocity_rad_s);
  const double moving_Nm = friction.coulomb_Nm + friction.viscous_Nms_rad * std::abs(velocity_rad_s);
  return (zero_weight * friction.static_Nm + (1.0 - zero_weight) * moving_Nm) * sign(velocity_rad_s);
}

double FuzzyFriction::largest_viscous_Nms_rad() const noexcept {
  double largest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_count); ++i)
    largest = std::max(largest, rules[i].friction.viscous_Nms_rad);
  return largest;
}

}  // namespace strainwave
