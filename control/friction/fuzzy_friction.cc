// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

namespace strainwave {

double VelocityMemberships::zero_weight(double velocity_rad_s) const noexcept {
  const double speed_rad_s = std::abs(velocity_rad_s);
  const double beyond_zero = std::max(0.0, speed_rad_s - zero_center_rad_s) * (1.0 / zero_width_rad_s);
  const double below_high = std::max(0.0, high_center_rad_s - speed_rad_s) * (1.0 / high_width_rad_s);
  // One exponential of the difference replaces the quotient of both, so that neither can underflow.
  return 1.0 / (1.0 + std::exp(beyond_zero * beyond_zero - below_high * below_high));
}

// Memberships are relative to the nearest rule's, so that far from every centre they are not 0/0.
TemperatureWeights FuzzyFriction::weights(double temperature_C) const noexcept {
  assert(rule_count >= 1 && rule_count <= kMaxTemperatureRules);
  TemperatureWeights result;
  result.count = rule_count;
  const std::span mu = std::span(result.weight).first(static_cast<std::size_t>(rule_count));
  const double clamped_C = std::clamp(temperature_C, temperature_min_C, temperature_max_C);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mu.size(); ++i) {
    const double distance = (clamped_C - rules[i].center_C) * (1.0 / rules[i].width_C);
    mu[i] = distance * distance;
    nearest = std::min(nearest, mu[i]);
  }
  double sum = 0.0;
  for (double& weight : mu) sum += weight = std::exp(nearest - weight);
  for (double& weight : mu) weight *= 1.0 / sum;
  return result;
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
