// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_catalogue.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "control/joint/gear_catalogue.h"
#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

constexpr double kRatio = 50.0;

const CatalogueJoint& catalogue_joint() {
  return *find_catalogue_joint("rhs17-6006");
}

FuzzyFriction declared(const char* table) {
  return read_gain_table(std::string(STRAINWAVE_SOURCE_DIR "/data/tables/") + table).friction;
}

/// `friction` with this share of each of its parameters.
FuzzyFriction scaled(FuzzyFriction friction, double breakaway, double coulomb, double viscous) {
  for (TemperatureRule& rule : friction.rules) {
    rule.friction.static_Nm *= breakaway;
    rule.friction.coulomb_Nm *= coulomb;
    rule.friction.viscous_Nms_rad *= viscous;
  }
  return friction;
}

std::optional<std::string> excess(const FuzzyFriction& friction) {
  return find_excess_friction(friction, catalogue_joint(), kRatio);
}

TEST(JointCatalogue, HasTheCataloguesFrictionAtTheJointsSide) {
  const FrictionParameters warm = catalogue_joint().friction_at(40.0, kRatio);
  EXPECT_NEAR(warm.static_Nm, 2.9667 * 0.01 * 50.0, 1e-12);
  EXPECT_NEAR(warm.coulomb_Nm, 1.3667 * 0.01 * 50.0, 1e-12);
  EXPECT_NEAR(warm.viscous_Nms_rad, 0.00087619 * 0.01 * 60.0 / (2.0 * std::numbers::pi) * 2500.0, 1e-12);
  const FrictionParameters between = catalogue_joint().friction_at(38.75, kRatio);
  EXPECT_NEAR(between.static_Nm, 0.25 * (2.9667 + 3.0333), 1e-12);
  EXPECT_EQ(catalogue_joint().friction_at(95.0, kRatio).coulomb_Nm, warm.coulomb_Nm);
  EXPECT_EQ(catalogue_joint().friction_at(-60.0, kRatio).coulomb_Nm,
            catalogue_joint().friction_at(-10.0, kRatio).coulomb_Nm);
  EXPECT_EQ(find_catalogue_joint("another"), nullptr);
}

TEST(JointCatalogue, HasTheActuatorsOwnInertiaAndFindsItByItsGear) {
  const CatalogueJoint* const joint = find_catalogue_joint_with_gear("csf-17-50");
  ASSERT_NE(joint, nullptr);
  EXPECT_EQ(joint->model, "rhs17-6006");
  EXPECT_EQ(joint->motor_inertia_kgm2, 0.089) << "inertia_at_output of the data sheet";
  EXPECT_EQ(find_catalogue_joint_with_gear("csf-20-50"), nullptr);
  for (const CatalogueJoint& each : joint_catalogue()) {
    ASSERT_NE(find_gear(each.gear), nullptr) << each.gear;
    EXPECT_EQ(find_gear(each.gear)->ratio, kRatio) << "that of its friction's motor side";
  }
}

TEST(JointCatalogue, AllowsWhatIsFittedToItAndWhatAStifferJointWouldIdentify) {
  for (const char* table : {"rhs17-6006.json", "csf-17-50.json", "c4.json", "total-1.089/c4.json"})
    EXPECT_EQ(excess(declared(table)), std::nullopt) << table;
  EXPECT_EQ(excess(scaled(declared("rhs17-6006.json"), 1.3, 1.3, 1.3)), std::nullopt);
  EXPECT_EQ(excess(scaled(declared("rhs17-6006.json"), 0.0, 0.0, 0.0)), std::nullopt);
}

TEST(JointCatalogue, NamesThePlaceOfTooMuchFrictionWhateverPartOfItIs) {
  const FuzzyFriction own = declared("rhs17-6006.json");
  ASSERT_TRUE(excess(scaled(own, 2.5, 1.0, 1.0)));
  EXPECT_NE(excess(scaled(own, 2.5, 1.0, 1.0))->find("degC and 0 rad/s"), std::string::npos)
      << *excess(scaled(own, 2.5, 1.0, 1.0));
  EXPECT_TRUE(excess(scaled(own, 1.0, 2.5, 1.0)));
  EXPECT_TRUE(excess(scaled(own, 1.0, 1.0, 3.0)));
}

TEST(JointCatalogue, FindsTooMuchFrictionAtOneTemperatureAlone) {
  FuzzyFriction friction = declared("rhs17-6006.json");
  TemperatureRule& warmest = friction.rules[static_cast<std::size_t>(friction.rule_count++)];
  warmest = {25.004, 0.001, {8.0, 8.0, 0.05}};
  const auto found = excess(friction);
  ASSERT_TRUE(found);
  EXPECT_NE(found->find(" at 25 degC and "), std::string::npos) << *found;
}

}  // namespace
}  // namespace strainwave
