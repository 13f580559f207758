// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/memberships.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "control/friction/fuzzy_friction.h"

namespace strainwave {

TemperatureMemberships::TemperatureMemberships(const FuzzyFriction& friction) noexcept
    : count_(friction.rule_count), min_C_(friction.temperature_min_C), max_C_(friction.temperature_max_C) {
  assert(count_ >= 1 && count_ <= kMaxTemperatureRules);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
    center_C_[i] = friction.rules[i].center_C;
    reciprocal_width_[i] = 1.0 / friction.rules[i].width_C;
  }
}

// Relative to the nearest rule's, which has 1, so that far from every centre they are never 0/0.
TemperatureWeights TemperatureMemberships::weights(double temperature_C) const noexcept {
  TemperatureWeights result;
  result.count = count_;
  const std::span mu = std::span(result.weight).first(static_cast<std::size_t>(count_));
  const double clamped_C = std::clamp(temperature_C, min_C_, max_C_);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mu.size(); ++i) {
    const double distance = (clamped_C - center_C_[i]) * reciprocal_width_[i];
    mu[i] = distance * distance;
    nearest = std::min(nearest, mu[i]);
  }
  double sum = 0.0;
  for (double& weight : mu) sum += weight = std::exp(nearest - weight);
  for (double& weight : mu) weight *= 1.0 / sum;
  return result;
}

ZeroVelocityWeight::ZeroVelocityWeight(const VelocityMemberships& memberships) noexcept
    : zero_center_rad_s_(memberships.zero_center_rad_s),
      high_center_rad_s_(memberships.high_center_rad_s),
      reciprocal_zero_width_s_rad_(1.0 / memberships.zero_width_rad_s),
      reciprocal_high_width_s_rad_(1.0 / memberships.high_width_rad_s) {}

double ZeroVelocityWeight::at(double velocity_rad_s) const noexcept {
  const double speed_rad_s = std::abs(velocity_rad_s);
  const double beyond_zero = std::max(0.0, speed_rad_s - zero_center_rad_s_) * reciprocal_zero_width_s_rad_;
  const double below_high = std::max(0.0, high_center_rad_s_ - speed_rad_s) * reciprocal_high_width_s_rad_;
  // The quotient of the two is taken inside one exponential, so that neither can underflow.
  return 1.0 / (1.0 + std::exp(beyond_zero * beyond_zero - below_high * below_high));
}

}  // namespace strainwave
