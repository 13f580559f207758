// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "control/table/gain_table_json.h"
#include "tests/support/reference_joint.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

TEST(GainTable, TheReferenceTableHasNoDefect) {
  EXPECT_EQ(find_defect(testing::shipped_table("c4")), std::nullopt);
}

TEST(GainTable, EveryNumberThatIsNotFiniteIsADefect) {
  const std::vector<std::function<double&(GainTable&)>> numbers{
      [](GainTable& t) -> double& { return t.plant.inertia_kgm2; },
      [](GainTable& t) -> double& { return t.plant.gear_ratio; },
      [](GainTable& t) -> double& { return t.plant.period_s; },
      [](GainTable& t) -> double& { return t.friction.temperature_min_C; },
      [](GainTable& t) -> double& { return t.friction.temperature_max_C; },
      [](GainTable& t) -> double& { return t.friction.velocity.zero_center_rad_s; },
      [](GainTable& t) -> double& { return t.friction.velocity.zero_width_rad_s; },
      [](GainTable& t) -> double& { return t.friction.velocity.high_center_rad_s; },
      [](GainTable& t) -> double& { return t.friction.velocity.high_width_rad_s; },
      [](GainTable& t) -> double& { return t.friction.rules[2].center_C; },
      [](GainTable& t) -> double& { return t.friction.rules[2].width_C; },
      [](GainTable& t) -> double& { return t.friction.rules[2].friction.static_Nm; },
      [](GainTable& t) -> double& { return t.friction.rules[2].friction.coulomb_Nm; },
      [](GainTable& t) -> double& { return t.friction.rules[2].friction.viscous_Nms_rad; },
      [](GainTable& t) -> double& { return t.torque_limit_Nm; },
      [](GainTable& t) -> double& { return t.primary.weights.integral; },
      [](GainTable& t) -> double& { return t.primary.weights.position; },
      [](GainTable& t) -> double& { return t.primary.weights.velocity; },
      [](GainTable& t) -> double& { return t.primary.weights.torque; },
      [](GainTable& t) -> double& { return t.primary.decay_rate; },
      [](GainTable& t) -> double& { return t.primary.cost_bound; },
      [](GainTable& t) -> double& { return t.primary.F[3][1]; },
      [](GainTable& t) -> double& { return t.primary.P[3][4]; },
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (const double bad :
         {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
      GainTable table = testing::shipped_table("c4");
      numbers[i](table) = bad;
      EXPECT_NE(find_defect(table), std::nullopt) << "number " << i << " = " << bad;
    }
  }
}

TEST(GainTable, CountsOutsideTheirRangeAreDefectsAndNotReadAsIndices) {
  for (const std::int32_t bad : {-1, 0, kMaxTemperatureRules + 1, 2000000000}) {
    GainTable table = testing::shipped_table("c4");
    table.friction.rule_count = bad;
    EXPECT_NE(find_defect(table), std::nullopt);
  }
  for (const std::int32_t bad : {-1, 0, 2, 5, 7, kMaxRules + 1, 2000000000}) {
    GainTable table = testing::shipped_table("c4");
    table.primary.rule_count = bad;
    EXPECT_NE(find_defect(table), std::nullopt);
  }
}

TEST(GainTable, AnAsymmetricLyapunovMatrixIsADefectAndItsRuleIsNamed) {
  GainTable table = testing::shipped_table("c4");
  table.primary.P[2][1] += 1e-9;
  ASSERT_NE(find_defect(table), std::nullopt);
  EXPECT_NE(find_defect(table)->find("primary.rules[2].P = "), std::string::npos) << *find_defect(table);
}

TEST(GainTable, HiddenContentBeyondTheCountsIsADefect) {
  GainTable table = testing::shipped_table("c4");
  table.primary.F[kMaxRules - 1][0] = 1.0;
  EXPECT_NE(find_defect(table), std::nullopt);
  table = testing::shipped_table("c4");
  table.name.bytes[40] = 'x';
  EXPECT_NE(find_defect(table), std::nullopt);
  table = testing::shipped_table("c4");
  table.friction.rules[kMaxTemperatureRules - 1].width_C = 1.0;
  EXPECT_NE(find_defect(table), std::nullopt);
  table = testing::shipped_table("c4");
  table.primary.has_integrator = 2;
  EXPECT_NE(find_defect(table).value_or("").find("has_integrator = 2: must be 0 or 1"), std::string::npos);
  table = testing::shipped_table("c4");
  table.name.bytes.fill('x');
  EXPECT_NE(find_defect(table), std::nullopt) << "not terminated";
}

// As a message brings it: a few numbers anywhere are others.
TEST(GainTable, OfWhateverBytesIsRefusedOrIsWhatItsFileSays) {
  const GainTable sound = testing::shipped_table("csf-17-50-delays");
  std::mt19937_64 random(36);
  const std::array values{0.0, -1.0, 1.0, 2.0, 1e300, std::nan(""), 5e-324};
  int kept = 0;
  for (int i = 0; i < 3000; ++i) {
    GainTable table = sound;
    auto* bytes = reinterpret_cast<std::byte*>(&table);
    for (std::size_t change = 0; change <= random() % 2; ++change) {
      const double value = values[random() % values.size()];
      const auto number = static_cast<std::uint32_t>(random());
      const std::size_t at = random() % (sizeof table / sizeof value) * sizeof value;
      // Half of the changes are among the counts and names, which are few.
      if (random() % 2 == 0)
        std::memcpy(bytes + at, &value, sizeof value);
      else
        std::memcpy(bytes + at % 600, &number, sizeof number);
    }
    if (find_defect(table)) continue;
    EXPECT_EQ(gain_table_from_json(to_json(table), "table.json"), table);
    ++kept;
  }
  EXPECT_GT(kept, 100);
  EXPECT_LT(kept, 2000);
}

TEST(GainTable, FrictionIsJudgedBeforeADesignAndByItsFile) {
  GainTable table = testing::shipped_table("c4");
  EXPECT_NO_THROW(require_friction(table.friction, 34.0, "fit.json"));
  table.friction.rules[1].friction.static_Nm = -1.0;
  EXPECT_EQ(testing::refusal_of([&] { require_friction(table.friction, 34.0, "fit.json"); }),
            "fit.json: friction.rules[1].static_Nm = -1: must be from 0 to 17, half of torque_limit_Nm");
  table.friction.rules[1].width_C = 1e300;
  EXPECT_NE(testing::refusal_of([&] {
              require_friction(table.friction, 34.0, "fit.json");
            }).find("fit.json: friction.rules[1].width_C"),
            std::string::npos);
}

TEST(GainTable, AnEnumerationOutsideOfItsNamesIsADefect) {
  for (const std::int32_t bad : {-1, 2, 2000000000}) {
    GainTable table = testing::shipped_table("c4");
    table.box.encoder_side = static_cast<EncoderSide>(bad);
    EXPECT_NE(find_defect(table).value_or("").find("box.encoder_side"), std::string::npos) << bad;
    table = testing::shipped_table("c4");
    table.provenance.sampling = static_cast<Sampling>(bad);
    EXPECT_NE(find_defect(table).value_or("").find("provenance.sampling"), std::string::npos) << bad;
  }
  GainTable table = testing::shipped_table("csf-17-50-delays");
  table.box.cells[0].delay_periods = 2000000000;
  EXPECT_NE(find_defect(table).value_or("").find("box.cells[0].delay_periods"), std::string::npos);
  table = testing::shipped_table("c4");
  table.provenance.note = FixedString<64>("a\x1b[2Jb");
  EXPECT_NE(find_defect(table).value_or("").find("provenance.note"), std::string::npos);
}

TEST(GainTable, AControllerNameThatContradictsItsGainsIsADefect) {
  GainTable table = testing::shipped_table("c4");
  table.primary.controller = FixedString<8>("C3");
  EXPECT_NE(find_defect(table), std::nullopt);
}

TEST(GainTable, IdentityComparesModelInertiaRatioAndPeriod) {
  const GainTable table = testing::shipped_table("c4");
  EXPECT_EQ(find_identity_mismatch(table, table.plant), std::nullopt);
  PlantIdentity other = table.plant;
  other.inertia_kgm2 *= 1.0 + 1e-8;
  EXPECT_NE(find_identity_mismatch(table, other), std::nullopt);
  other = table.plant;
  other.inertia_kgm2 *= 1.0 + 1e-10;
  EXPECT_EQ(find_identity_mismatch(table, other), std::nullopt);
  other.period_s = 0.002;
  EXPECT_NE(find_identity_mismatch(table, other)->find("period_s"), std::string::npos);
  other = table.plant;
  other.joint_model = FixedString<32>("another");
  EXPECT_NE(find_identity_mismatch(table, other)->find("another"), std::string::npos);
}

TEST(GainTable, IdentityComparesGearsWhereTableAndJointNameOne) {
  GainTable table = testing::shipped_table("c4");
  PlantIdentity joint = table.plant;
  joint.gear = FixedString<32>("csf-17-50");
  EXPECT_EQ(find_identity_mismatch(table, joint), std::nullopt) << "the table names none";
  table.plant.gear = FixedString<32>("csf-20-50");
  EXPECT_EQ(find_identity_mismatch(table, testing::shipped_table("c4").plant), std::nullopt)
      << "the joint names none";
  const std::string mismatch = find_identity_mismatch(table, joint).value_or("");
  for (const char* part : {"plant.gear", "csf-20-50", "csf-17-50"})
    EXPECT_NE(mismatch.find(part), std::string::npos) << mismatch;
  joint.gear = table.plant.gear;
  EXPECT_EQ(find_identity_mismatch(table, joint), std::nullopt);
}

std::string defect_of(const std::function<void(GainTable&)>& change) {
  GainTable table = testing::shipped_table("c4");
  change(table);
  return find_defect(table).value_or("");
}

TEST(GainTable, ItsGearIsOneOfTheCatalogueWithItsRatio) {
  const auto named = [](const char* gear, double ratio) {
    return defect_of([&](GainTable& table) {
      table.plant.gear = FixedString<32>(gear);
      table.plant.gear_ratio = ratio;
    });
  };
  EXPECT_EQ(named("csf-17-50", 50.0), "");
  EXPECT_NE(named("csf-18-50", 50.0).find("plant.gear = \"csf-18-50\": must be empty or one of csf-14-50"),
            std::string::npos);
  EXPECT_NE(named("csf-17-100", 50.0).find("must be a gear of gear_ratio = 50"), std::string::npos);
}

TEST(GainTable, FrictionIsFrictionAndBelowTheTorqueLimit) {
  const auto friction = [](double factor) {
    return defect_of([factor](GainTable& table) {
      for (TemperatureRule& rule : table.friction.rules) {
        rule.friction.static_Nm *= factor;
        rule.friction.coulomb_Nm *= factor;
        rule.friction.viscous_Nms_rad *= factor;
      }
    });
  };
  EXPECT_EQ(friction(1.0), "");
  for (const double factor : {1000.0, 8.0, -1.0})
    EXPECT_NE(friction(factor).find("friction.rules[0].static_Nm"), std::string::npos) << friction(factor);
  const std::string below_coulomb =
      defect_of([](GainTable& t) { t.friction.rules[3].friction.static_Nm = 1.0; });
  EXPECT_NE(below_coulomb.find("friction.rules[3].coulomb_Nm"), std::string::npos) << below_coulomb;
  const std::string pushing =
      defect_of([](GainTable& t) { t.friction.rules[1].friction.viscous_Nms_rad = -0.1; });
  EXPECT_NE(pushing.find("friction.rules[1].viscous_Nms_rad"), std::string::npos) << pushing;
}

TEST(GainTable, FrictionIsWhatAJointCanNeed) {
  const auto declared = [](double static_Nm, double coulomb_Nm) {
    return defect_of([=](GainTable& table) {
      table.torque_limit_Nm = 34.0;
      for (int i = 0; i < table.friction.rule_count; ++i)
        table.friction.rules[static_cast<std::size_t>(i)].friction = {static_Nm, coulomb_Nm, 0.1};
    });
  };
  EXPECT_EQ(declared(0.0, 0.0), "") << "a joint may have none";
  EXPECT_EQ(declared(17.0, 3.4), "");
  EXPECT_NE(declared(17.1, 17.0).find("half of torque_limit_Nm"), std::string::npos) << declared(17.1, 17.0);
}

TEST(GainTable, MembershipsOfSpeedHaveAWidth) {
  for (const double width : {1e-320, 1e-10, 0.0, -1.0}) {
    EXPECT_NE(defect_of([width](GainTable& t) {
                t.friction.velocity.zero_width_rad_s = width;
              }).find("zero_width_rad_s"),
              std::string::npos);
    EXPECT_NE(defect_of([width](GainTable& t) {
                t.friction.velocity.high_width_rad_s = width;
              }).find("high_width_rad_s"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace strainwave
