// SPDX-License-Identifier: BSD-3-Clause
// Friction as JSON (base/json_fields.h), in gain tables and in the friction files of strainwave-design fit: at one temperature, as a law
// over temperature and speed, and as fuzzy rules. Joint side. Not real-time.
#pragma once

#include <filesystem>

#include "base/json_fields.h"
#include "control/friction/fuzzy_friction.h"

namespace strainwave {

template <typename Json>
void fields(Json& json, FrictionParameters& parameters) {
  json("static_Nm", parameters.static_Nm);
  json("coulomb_Nm", parameters.coulomb_Nm);
  json("viscous_Nms_rad", parameters.viscous_Nms_rad);
}

template <typename Json>
void fields(Json& json, FrictionLaw& law) {
  json("asymptote", law.over_temperature.asymptote);
  json("amplitude", law.over_temperature.amplitude);
  json("reference_C", law.over_temperature.reference_C);
  json("decay_C", law.over_temperature.decay_C);
  json.require(law.over_temperature.decay_C > 0.0, "decay_C", "above 0");
  json("stribeck_velocity_rad_s", law.stribeck.velocity_rad_s);
  json.require(law.stribeck.velocity_rad_s > 0.0, "stribeck_velocity_rad_s", "above 0");
  json("stribeck_exponent", law.stribeck.exponent);
  json.require(law.stribeck.exponent >= 0.5, "stribeck_exponent", "at least 0.5");
}

/// In SI. No joint has larger numbers, and arithmetic with smaller ones cannot overflow.
inline constexpr double kMost = 1e15;
inline constexpr Range kZeroOrMore{0.0, kMost};
inline constexpr Range kTemperature_C{-273.15, kMost};

template <typename Json>
void fields(Json& json, VelocityMemberships& velocity) {
  ranged(json, "zero_center_rad_s", velocity.zero_center_rad_s, kZeroOrMore);
  ranged(json, "zero_width_rad_s", velocity.zero_width_rad_s, kPositive);
  ranged(json, "high_center_rad_s", velocity.high_center_rad_s, kZeroOrMore);
  ranged(json, "high_width_rad_s", velocity.high_width_rad_s, kPositive);
}

/// The ranges of friction are not checked here: a fit may exceed those that a gain table must keep (gain_table_json.cc).
template <typename Json>
void fields(Json& json, FuzzyFriction& friction) {
  ranged(json, "temperature_min_C", friction.temperature_min_C, kTemperature_C);
  ranged(json, "temperature_max_C", friction.temperature_max_C, kTemperature_C);
  json.require(friction.temperature_min_C < friction.temperature_max_C, "temperature_max_C",
               "above temperature_min_C");
  json("velocity", friction.velocity);
  json.list("rules", friction.rule_count, 1, kMaxTemperatureRules, [&](auto& entry, std::size_t i) {
    TemperatureRule& rule = friction.rules[i];
    ranged(entry, "center_C", rule.center_C, kTemperature_C);
    entry.require(i == 0 || friction.rules[i - 1].center_C < rule.center_C, "center_C",
                  "above that of the rule before");
    ranged(entry, "width_C", rule.width_C, kPositive);
    fields(entry, rule.friction);
  });
}

/// Reads the law from a friction file of strainwave-design fit. Throws InputError if the file has no law for this ratio.
FrictionLaw read_friction_law(const std::filesystem::path& path, double gear_ratio);

}  // namespace strainwave
