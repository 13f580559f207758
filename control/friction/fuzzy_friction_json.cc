// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction_json.h"

#include <nlohmann/json.hpp>

#include "control/friction/friction_law_json.h"

namespace strainwave {

using nlohmann::ordered_json;

ordered_json fuzzy_friction_to_json(const FuzzyFriction& friction) {
  ordered_json rules = ordered_json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(friction.rule_count); ++i) {
    const TemperatureRule& rule = friction.rules[i];
    rules.push_back({{"center_C", rule.center_C}, {"width_C", rule.width_C}});
    rules.back().update(friction_parameters_to_json(rule.friction));
  }
  return {{"temperature_min_C", friction.temperature_min_C},
          {"temperature_max_C", friction.temperature_max_C},
          {"velocity",
           {{"zero_center_rad_s", friction.velocity.zero_center_rad_s},
            {"zero_width_rad_s", friction.velocity.zero_width_rad_s},
            {"high_center_rad_s", friction.velocity.high_center_rad_s},
            {"high_width_rad_s", friction.velocity.high_width_rad_s}}},
          {"rules", std::move(rules)}};
}

FuzzyFriction fuzzy_friction_from_json(StrictObject object) {
  FuzzyFriction friction;
  friction.temperature_min_C = object.number("temperature_min_C");
  friction.temperature_max_C = object.number("temperature_max_C");
  StrictObject velocity = object.object("velocity");
  friction.velocity.zero_center_rad_s = velocity.number("zero_center_rad_s");
  friction.velocity.zero_width_rad_s = velocity.number("zero_width_rad_s");
  friction.velocity.high_center_rad_s = velocity.number("high_center_rad_s");
  friction.velocity.high_width_rad_s = velocity.number("high_width_rad_s");
  velocity.finish();
  std::vector<StrictObject> rules = object.objects("rules", 1, kMaxTemperatureRules);
  friction.rule_count = static_cast<std::int32_t>(rules.size());
  for (std::size_t i = 0; i < rules.size(); ++i) {
    TemperatureRule& rule = friction.rules[i];
    rule.center_C = rules[i].number("center_C");
    rule.width_C = rules[i].number("width_C");
    rule.friction = friction_parameters_from_json(rules[i]);
    rules[i].finish();
  }
  object.finish();
  return friction;
}

}  // namespace strainwave
