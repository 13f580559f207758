// SPDX-License-Identifier: BSD-3-Clause
// The cascaded Takagi-Sugeno friction model that the controller carries. Joint side, SI. Real-time safe.
//
// Layer 1 (temperature, may run slowly): Gaussian memberships mu_i(T) = exp(-((T - center_i)/width_i)^2)
// blend the rules' friction parameters. Layer 2 (velocity, every sample): two memberships, "zero" and "high",
// blend static friction with Coulomb plus viscous friction. Source: Zhao (2006), (3-1)..(3-8).
#pragma once

#include <array>
#include <cstdint>

#include "control/friction/friction.h"

namespace strainwave {

inline constexpr int kMaxTemperatureRules = 16;

/// Normalised memberships of layer 1: each >= 0, sum 1 over the first `count`.
struct TemperatureWeights {
  std::array<double, kMaxTemperatureRules> weight{};
  std::int32_t count = 0;
};

/// One rule of layer 1: "if T is about center_C, friction is ...". width_C > 0.
struct TemperatureRule {
  double center_C = 0.0;
  double width_C = 0.0;
  FrictionParameters friction;

  bool operator==(const TemperatureRule&) const = default;
};

/// Layer 2, joint side. mu_zero is 1 up to zero_center and falls as exp(-((|w|-zero_center)/zero_width)^2)
/// beyond it; mu_high is 1 from high_center and falls in the same way below it. Widths > 0, centres >= 0.
struct VelocityMemberships {
  double zero_center_rad_s = 0.0;
  double zero_width_rad_s = 1.0;
  double high_center_rad_s = 1.0;
  double high_width_rad_s = 1.0;

  /// The Stribeck curve of these memberships: half of zero_width_rad_s as velocity, exponent 2. With Zhao's memberships (2006, section 3)
  /// that is the catalogue's Stribeck velocity, 20 RPM of the motor.
  constexpr StribeckShape stribeck() const noexcept { return {0.5 * zero_width_rad_s, 2.0}; }
  /// alpha_0 = mu_zero / (mu_zero + mu_high), in (0, 1), even in velocity.
  double zero_weight(double velocity_rad_s) const noexcept;
  bool operator==(const VelocityMemberships&) const = default;
};

/// The whole model, as a gain table contains it. 1 <= rule_count <= kMaxTemperatureRules, centres ascending.
struct FuzzyFriction {
  std::int32_t rule_count = 0;
  std::array<TemperatureRule, kMaxTemperatureRules> rules{};
  VelocityMemberships velocity;
  double temperature_min_C = 0.0;  ///< Range the rules were fitted over; temperatures are clamped to it.
  double temperature_max_C = 0.0;

  /// Normalised memberships at `temperature_C`, which is clamped to the range first; it must not be NaN.
  TemperatureWeights weights(double temperature_C) const noexcept;

  /// Layer 1: the friction parameters blended by `weights`.
  FrictionParameters blend(const TemperatureWeights& weights) const noexcept;

  /// The largest viscous coefficient of a rule, >= 0.
  double largest_viscous_Nms_rad() const noexcept;
  bool operator==(const FuzzyFriction&) const = default;
};

}  // namespace strainwave
