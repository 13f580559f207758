// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

FuzzyFriction two_rules() {
  FuzzyFriction friction;
  friction.rule_count = 2;
  friction.rules[0] = {-10.0, 22.5, {4.4, 3.6, 2.3}};
  friction.rules[1] = {40.0, 0.1 + 0.2, {1.1, 0.9, 1.0 / 3.0}};
  friction.velocity = {0.001, 0.084, 0.2, 0.05};
  friction.temperature_min_C = -10.0;
  friction.temperature_max_C = 40.0;
  return friction;
}

std::string complaint_about(const nlohmann::ordered_json& json) {
  return testing::refusal_of([&] { (void)fuzzy_friction_from_json(StrictObject(json, "friction.json")); });
}

TEST(FuzzyFrictionJson, GivesBackEveryNumberToTheLastBit) {
  const FuzzyFriction written = two_rules();
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(fuzzy_friction_to_json(written).dump());
  const FuzzyFriction read = fuzzy_friction_from_json(StrictObject(json, "friction.json"));
  ASSERT_EQ(read.rule_count, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.rules[i].center_C, written.rules[i].center_C);
    EXPECT_EQ(read.rules[i].width_C, written.rules[i].width_C);
    EXPECT_EQ(read.rules[i].friction.static_Nm, written.rules[i].friction.static_Nm);
    EXPECT_EQ(read.rules[i].friction.coulomb_Nm, written.rules[i].friction.coulomb_Nm);
    EXPECT_EQ(read.rules[i].friction.viscous_Nms_rad, written.rules[i].friction.viscous_Nms_rad);
  }
  EXPECT_EQ(read.velocity.zero_center_rad_s, written.velocity.zero_center_rad_s);
  EXPECT_EQ(read.velocity.zero_width_rad_s, written.velocity.zero_width_rad_s);
  EXPECT_EQ(read.velocity.high_center_rad_s, written.velocity.high_center_rad_s);
  EXPECT_EQ(read.velocity.high_width_rad_s, written.velocity.high_width_rad_s);
  EXPECT_EQ(read.temperature_min_C, written.temperature_min_C);
  EXPECT_EQ(read.temperature_max_C, written.temperature_max_C);
}

TEST(FuzzyFrictionJson, NamesTheFileAndTheKeyThatIsMissingOrTooMuch) {
  nlohmann::ordered_json without = fuzzy_friction_to_json(two_rules());
  without["rules"][1].erase("coulomb_Nm");
  const std::string missing = complaint_about(without);
  EXPECT_NE(missing.find("friction.json"), std::string::npos) << missing;
  EXPECT_NE(missing.find("coulomb_Nm"), std::string::npos) << missing;
  nlohmann::ordered_json with = fuzzy_friction_to_json(two_rules());
  with["velocity"]["zero_with_rad_s"] = 1.0;
  const std::string unknown = complaint_about(with);
  EXPECT_NE(unknown.find("zero_with_rad_s"), std::string::npos) << unknown;
}

TEST(FuzzyFrictionJson, TakesAsManyRulesAsATableHoldsAndAtLeastOne) {
  nlohmann::ordered_json json = fuzzy_friction_to_json(two_rules());
  const nlohmann::ordered_json rule = json["rules"][0];
  json["rules"] = nlohmann::ordered_json::array();
  EXPECT_NE(complaint_about(json).find("rules"), std::string::npos);
  for (int i = 0; i < kMaxTemperatureRules; ++i) json["rules"].push_back(rule);
  EXPECT_EQ(fuzzy_friction_from_json(StrictObject(json, "friction.json")).rule_count, kMaxTemperatureRules);
  json["rules"].push_back(rule);
  EXPECT_NE(complaint_about(json).find("rules"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
