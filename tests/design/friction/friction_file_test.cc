// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/input_error.h"
#include "base/text_file.h"
#include "base/units.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::filesystem::path kData = STRAINWAVE_SOURCE_DIR "/data";

TEST(FrictionFile, ReadsBackToTheSameText) {
  const std::string text = read_text_file(kData / "tables" / "rhs17-6006-friction.json");
  const FrictionFile file = friction_file_from_json(text, "test");
  EXPECT_TRUE(file.exponential && file.fuzzy);
  EXPECT_EQ(to_json(file), text);
}

TEST(FrictionFile, RefusesUnknownKeysOtherFormatsAndNonsense) {
  std::string text = read_text_file(kData / "tables" / "rhs17-6006-friction.json");
  text.replace(text.find("\"gear_ratio\""), 12, "\"ratio\"");
  EXPECT_THROW(friction_file_from_json(text, "test"), InputError);
  EXPECT_THROW(friction_file_from_json("{\"format\": 7}", "test"), InputError);
  EXPECT_THROW(friction_file_from_json("{", "test"), InputError);
}

TEST(FrictionFile, Table5IsTable4AtTheOtherSideOfTheGear) {
  const FrictionRules table5 = read_friction_rules(kData / "fuzzy_rules_table5.csv", 50.0, GearSide::kJoint);
  const FrictionRules table4 = read_friction_rules(kData / "fuzzy_rules_table4.csv", 50.0, GearSide::kMotor);
  ASSERT_EQ(table4.friction.rule_count, 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const FrictionParameters& a = table4.friction.rules[i].friction;
    const FrictionParameters& b = table5.friction.rules[i].friction;
    EXPECT_NEAR(a.static_Nm, b.static_Nm, 1e-4 * b.static_Nm);
    EXPECT_NEAR(a.coulomb_Nm, b.coulomb_Nm, 1e-4 * b.coulomb_Nm);
    EXPECT_NEAR(a.viscous_Nms_rad, b.viscous_Nms_rad, 6e-4 * b.viscous_Nms_rad);
  }
  EXPECT_NEAR(table4.friction.velocity.high_width_rad_s, joint_velocity_rad_s_from_motor_rpm(80.0, 50.0),
              1e-15);
  EXPECT_EQ(table4.friction.velocity.high_width_rad_s, table5.friction.velocity.high_width_rad_s);
}

TEST(FrictionFile, RefusesRulesThatAreNotInOrderOrNotPhysical) {
  const TemporaryFolder temporary;
  const std::filesystem::path path = temporary.path() / "rules.csv";
  const auto message_of = [&path](const std::string& rows) {
    std::ofstream(path) << "center_C,width_C,static_Ncm,coulomb_Ncm,viscous_Ncm_per_rpm\n" << rows;
    return testing::refusal_of([&] { read_friction_rules(path, 50.0, GearSide::kJoint); });
  };
  EXPECT_EQ(message_of("0,5,2,1,1\n10,5,2,1,1\n"), "accepted");
  EXPECT_NE(message_of("0,5,2,1,1\n0,5,2,1,1\n").find(".csv:3:"), std::string::npos);
  EXPECT_NE(message_of("0,0,2,1,1\n").find("width_C"), std::string::npos);
  EXPECT_NE(message_of("0,5,2,-1,1\n").find("negative"), std::string::npos);
}

TEST(FrictionFile, ARatioThatContradictsTheFileIsRefused) {
  EXPECT_THROW(read_friction_rules(kData / "tables" / "rhs17-6006-friction.json", 100.0, GearSide::kJoint),
               InputError);
  EXPECT_NO_THROW(read_friction_rules(kData / "tables" / "rhs17-6006-friction.json", 50.0, GearSide::kJoint));
}

}  // namespace
}  // namespace strainwave
