// SPDX-License-Identifier: BSD-3-Clause
// The memberships of both layers, prepared for the loop: what depends neither on temperature nor on velocity
// is computed when the table is loaded. Real-time safe. Source: Zhao (2006), (3-1)..(3-8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace strainwave {

struct FuzzyFriction;
struct VelocityMemberships;

inline constexpr int kMaxTemperatureRules = 16;

/// Normalised memberships of layer 1: each >= 0, sum 1 over the first `count`.
struct TemperatureWeights {
  std::array<double, kMaxTemperatureRules> weight{};
  std::int32_t count = 0;
};

class TemperatureMemberships {
 public:
  TemperatureMemberships() = default;
  /// `friction` must have passed find_defect().
  explicit TemperatureMemberships(const FuzzyFriction& friction) noexcept;

  /// Normalised memberships at `temperature_C`, which is
  /// clamped to the table's range first; it must not be NaN.
  TemperatureWeights weights(double temperature_C) const noexcept;

 private:
  std::int32_t count_ = 0;
  double min_C_ = 0.0;
  double max_C_ = 0.0;
  std::array<double, kMaxTemperatureRules> center_C_{};
  std::array<double, kMaxTemperatureRules> reciprocal_width_{};  ///< 1/degC
};

class ZeroVelocityWeight {
 public:
  ZeroVelocityWeight() = default;
  explicit ZeroVelocityWeight(const VelocityMemberships& memberships) noexcept;

  /// alpha_0 = mu_zero / (mu_zero + mu_high) of layer 2, in (0, 1), even in velocity.
  double at(double velocity_rad_s) const noexcept;

 private:
  double zero_center_rad_s_ = 0.0;
  double high_center_rad_s_ = 1.0;
  double reciprocal_zero_width_s_rad_ = 1.0;
  double reciprocal_high_width_s_rad_ = 1.0;
};

}  // namespace strainwave
