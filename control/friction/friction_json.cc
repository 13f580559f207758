// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/friction_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text_file.h"

namespace strainwave {

using nlohmann::ordered_json;

namespace {

FrictionParameters part_from_json(StrictObject part) {
  const FrictionParameters parameters = friction_parameters_from_json(part);
  part.finish();
  return parameters;
}

}  // namespace

ordered_json friction_parameters_to_json(const FrictionParameters& parameters) {
  return {{"static_Nm", parameters.static_Nm},
          {"coulomb_Nm", parameters.coulomb_Nm},
          {"viscous_Nms_rad", parameters.viscous_Nms_rad}};
}

FrictionParameters friction_parameters_from_json(StrictObject& object) {
  FrictionParameters parameters;
  parameters.static_Nm = object.number("static_Nm");
  parameters.coulomb_Nm = object.number("coulomb_Nm");
  parameters.viscous_Nms_rad = object.number("viscous_Nms_rad");
  return parameters;
}

FrictionLaw friction_law_from_json(StrictObject& object) {
  FrictionLaw law;
  law.over_temperature.asymptote = part_from_json(object.object("asymptote"));
  law.over_temperature.amplitude = part_from_json(object.object("amplitude"));
  law.over_temperature.reference_C = object.number("reference_C");
  law.over_temperature.decay_C = object.number("decay_C");
  if (!(law.over_temperature.decay_C > 0.0)) throw InputError(object.where("decay_C") + ": must be above 0");
  law.stribeck.velocity_rad_s = object.number("stribeck_velocity_rad_s");
  if (!(law.stribeck.velocity_rad_s > 0.0))
    throw InputError(object.where("stribeck_velocity_rad_s") + ": must be above 0");
  law.stribeck.exponent = object.number("stribeck_exponent");
  if (!(law.stribeck.exponent >= 0.5))
    throw InputError(object.where("stribeck_exponent") + ": must be at least 0.5");
  return law;
}

FrictionLaw read_friction_law(const std::filesystem::path& path, double gear_ratio) {
  const std::string source = path.string();
  const ordered_json document = parse_strict_json(read_text_file(path), source);
  StrictObject object(document, source);
  const double ratio = object.number("gear_ratio");
  if (!(std::abs(ratio - gear_ratio) <= 1e-9 * gear_ratio))
    throw InputError(source, "gear_ratio", number_text(ratio),
                     "must be the joint's, " + number_text(gear_ratio) + ": fit with --gear-ratio " +
                         number_text(gear_ratio));
  if (!object.has("exponential"))
    throw InputError(source + ": has no law: fit with strainwave-design fit --model both");
  StrictObject law = object.object("exponential");
  return friction_law_from_json(law);
}

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
