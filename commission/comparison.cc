// SPDX-License-Identifier: BSD-3-Clause
#include "commission/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"
#include "control/joint/torsion_spring.h"

namespace strainwave {

namespace {

constexpr double kMostFactor = 1.3;
// Factors with one common cause agree within this factor. With the ratio, the stiffness in data/gears.csv changes, too.
constexpr double kSameFactor = 1.3;
// A delay is configured in whole periods.
constexpr double kDelayTolerance_periods = 0.75;
constexpr double kZeroTolerance_rad = 0.3;
// Largest half interval of a reported gravity, as a share of it. Friction that varies with position looks like a weight with 0.4 or more.
constexpr double kGravityKnownShare = 0.25;

constexpr const char* kMotorKey = "motor_inertia_kgm2";
constexpr const char* kLoadKey = "load_inertia_kgm2";
constexpr const char* kStiffnessKey = "stiffness_Nm_rad";
constexpr const char* kZeroKey = "control.gravity_zero_rad";
constexpr const char* kPeriods = "periods";
// Names of numbers without a key.
constexpr const char* kTotal = "inertia of motor and load";
constexpr const char* kResonance = "resonance";

bool same(double a, double b) {
  return std::max(a / b, b / a) < kSameFactor;
}

/// Configured over measured value; 0: one of them is missing.
double factor_of(const std::vector<CommissionValue>& values, const char* key) {
  const CommissionValue* const found = find_value(values, key);
  return found == nullptr ? 0.0 : found->configured.value_or(0.0) / found->measured.value;
}

/// The common factor of link and spring, which shows a wrong scale of torque or position. The motor must share it, or have a factor of 1:
/// its configured inertia at the joint was then computed with the same ratio.
std::optional<double> wrong_scale(const std::vector<CommissionValue>& values) {
  const double link = factor_of(values, kLoadKey);
  const double spring = factor_of(values, kStiffnessKey);
  const double motor = factor_of(values, kMotorKey);
  if (link <= 0.0 || spring <= 0.0 || motor <= 0.0 || !same(link, spring)) return std::nullopt;
  const double factor = std::sqrt(link * spring);
  if (std::max(factor, 1.0 / factor) < kMostFactor) return std::nullopt;
  if (!same(motor, factor) && !same(motor, 1.0)) return std::nullopt;
  return factor;
}

}  // namespace

std::vector<CommissionValue> compare_with(const ConfiguredNumbers& configured,
                                          const MotionEstimates& motion) {
  std::vector<CommissionValue> values;
  const auto add = [&](std::string key, const char* unit, const std::optional<double>& told,
                       const std::optional<IntervalEstimate>& found) {
    if (found) values.push_back({std::move(key), unit, told, *found, found->value});
  };
  add(kMotorKey, "kg.m2", configured.motor_inertia_kgm2, motion.motor_inertia_kgm2);
  add(kLoadKey, "kg.m2", configured.load_inertia_kgm2, motion.link_inertia_kgm2);
  add(kStiffnessKey, "N.m/rad", configured.stiffness_1_Nm_rad, motion.stiffness_1_Nm_rad);
  add("damping_Nms_rad", "N.m.s/rad", configured.damping_Nms_rad, motion.damping_Nms_rad);
  const double period_s = configured.period_s;
  add(configured.delay_key, kPeriods, configured.delay_periods,
      IntervalEstimate{motion.delay_s.value / period_s, motion.delay_s.half_width_95 / period_s});
  values.back().used = std::round(values.back().measured.value);
  const IntervalEstimate& gravity = motion.gravity_Nm;
  if (gravity.half_width_95 < kGravityKnownShare * gravity.value) {
    const std::optional<GravityLoad>& told = configured.gravity;
    add("control.gravity_Nm", "N.m", told ? std::optional(told->torque_Nm) : std::nullopt, gravity);
    add(kZeroKey, "rad", told ? std::optional(told->zero_rad) : std::nullopt,
        IntervalEstimate{motion.gravity_zero_rad, gravity.half_width_95 / gravity.value});
  }
  std::optional<double> told_resonance_Hz;
  if (configured.motor_inertia_kgm2 && configured.load_inertia_kgm2 && configured.stiffness_1_Nm_rad)
    told_resonance_Hz =
        free_free_frequency_rad_s(*configured.motor_inertia_kgm2, *configured.load_inertia_kgm2,
                                  *configured.stiffness_1_Nm_rad) /
        kTurn_rad;
  add(kTotal, "kg.m2",
      configured.motor_inertia_kgm2 && configured.load_inertia_kgm2
          ? std::optional(*configured.motor_inertia_kgm2 + *configured.load_inertia_kgm2)
          : std::nullopt,
      motion.total_inertia_kgm2);
  add(kResonance, "Hz", told_resonance_Hz, motion.resonance_Hz);
  return values;
}

bool differs(const CommissionValue& value) {
  if (!value.configured) return false;
  const double configured = *value.configured;
  const IntervalEstimate& measured = value.measured;
  const double off = std::abs(configured - measured.value);
  if (value.unit == kPeriods) return off > kDelayTolerance_periods + measured.half_width_95;
  if (value.key == kZeroKey)
    return std::abs(std::remainder(off, kTurn_rad)) > kZeroTolerance_rad + measured.half_width_95;
  return configured > kMostFactor * (measured.value + measured.half_width_95) ||
         kMostFactor * configured < measured.value - measured.half_width_95;
}

std::string find_late(const std::vector<CommissionValue>& values) {
  for (const CommissionValue& value : values)
    if (value.unit == kPeriods && value.measured.value > kMostDelay_periods)
      return fmt::format(
          "{}: {:.2f} periods are measured, and a table allows at most {:g}: make the drive answer sooner, "
          "or give a longer daemon.period_s",
          value.key, value.measured.value, kMostDelay_periods);
  return "";
}

std::string find_wrong(const std::vector<CommissionValue>& values, double gear_ratio) {
  if (const std::optional<double> factor = wrong_scale(values))
    return fmt::format(
        "{} and {} are {:.2f} times the measured values, so one scale is wrong: either gear_ratio = {:g} "
        "should be {:.1f}, or the torque constant or the counts per revolution are {:.2f} times the right "
        "value",
        kLoadKey, kStiffnessKey, *factor, gear_ratio, gear_ratio * std::sqrt(*factor), 1.0 / *factor);
  // The total inertia is reported only if one of the two inertias is missing.
  const bool both = factor_of(values, kMotorKey) > 0.0 && factor_of(values, kLoadKey) > 0.0;
  std::string text;
  for (const CommissionValue& value : values)
    if (value.key != kResonance && (value.key != kTotal || !both) && differs(value))
      text += fmt::format("{}{} = {:.4g} is wrong: {:.4g} +-{:.2g} {} is measured", text.empty() ? "" : "; ",
                          value.key, *value.configured, value.measured.value, value.measured.half_width_95,
                          value.unit);
  return text;
}

}  // namespace strainwave
