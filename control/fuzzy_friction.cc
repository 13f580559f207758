#include "control/fuzzy_friction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "control/units.h"

namespace strainwave {

double VelocityMemberships::zero_weight(double velocity_rad_s) const noexcept {
  const double speed = std::abs(velocity_rad_s);
  const double beyond_zero = std::max(0.0, speed - zero_center_rad_s) / zero_width_rad_s;
  const double below_high = std::max(0.0, high_center_rad_s - speed) / high_width_rad_s;
  // mu_zero / (mu_zero + mu_high) with the quotient taken inside one exponential, so that neither can
  // underflow.
  return 1.0 / (1.0 + std::exp(beyond_zero * beyond_zero - below_high * below_high));
}

TemperatureWeights FuzzyFriction::weights(double temperature_C) const noexcept {
  assert(rule_count >= 1 && rule_count <= kMaxTemperatureRules);
  const double clamped_C = std::clamp(temperature_C, temperature_min_C, temperature_max_C);
  TemperatureWeights result;
  result.count = rule_count;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_count); ++i) {
    const double distance = (clamped_C - rules[i].center_C) / rules[i].width_C;
    result.weight[i] = -distance * distance;
    largest = std::max(largest, result.weight[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_count); ++i) {
    result.weight[i] = std::exp(result.weight[i] - largest);
    sum += result.weight[i];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_count); ++i) result.weight[i] /= sum;
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

double FuzzyFriction::torque_Nm(const FrictionParameters& friction, double velocity_rad_s) const noexcept {
  const double zero_weight = velocity.zero_weight(velocity_rad_s);
  const double moving_Nm = friction.coulomb_Nm + friction.viscous_Nms_rad * std::abs(velocity_rad_s);
  return (zero_weight * friction.static_Nm + (1.0 - zero_weight) * moving_Nm) * sign(velocity_rad_s);
}

}  // namespace strainwave
