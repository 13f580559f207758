// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/commission_design.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/input_error.h"
#include "base/text_file.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const JointToDesign kJoint{"csf-25-100", "csf-25-100", 0.001, false, 0.1};

CommissionRecord measured() {
  CommissionRecord record;
  record.values = {{"motor_inertia_kgm2", "", 0.7, {0.7234567, 0.02}, 0.7234567},
                   {"load_inertia_kgm2", "", 0.48, {0.5, 0.02}, 0.5},
                   {"stiffness_Nm_rad", "", 31000.0, {30000.0, 900.0}, 30000.0},
                   {"damping_Nms_rad", "", {}, {3.0, 2.5}, 3.0},
                   {"can.delay_periods", "periods", 1.0, {1.4, 0.1}, 1.0},
                   {"control.gravity_Nm", "", {}, {11.8, 0.2}, 11.8},
                   {"control.gravity_zero_rad", "", {}, {-0.3, 0.02}, -0.3},
                   {"resonance", "Hz", {}, {50.0, 0.3}, 50.0}};
  return record;
}

std::string argument(const std::vector<std::string>& arguments, const std::string& name) {
  const auto found = std::ranges::find(arguments, name);
  return found == arguments.end() ? "" : *(found + 1);
}

std::vector<std::string> gains() {
  return gains_arguments(measured(), kJoint, "friction.json", "table.json");
}

TEST(CommissionDesign, AsksForABoxThatHoldsTheIntervalOfEachNumber) {
  EXPECT_EQ(argument(gains(), "--load-inertia_kgm2"), "0.45..0.55");
  EXPECT_EQ(argument(gains(), "--stiffness_Nm_rad"), "29100..30900");
  EXPECT_EQ(argument(gains(), "--damping_Nms_rad"), "0.5..5.5");
  EXPECT_EQ(argument(gains(), "--delay"), "1..2") << "1.4 periods";
}

TEST(CommissionDesign, GivesTableAndConfigurationTheSameMotorInertia) {
  const auto settings = measured_settings(measured(), kJoint, "table.json");
  const auto motor = std::ranges::find(settings, "motor_inertia_kgm2", &JointSetting::key);
  ASSERT_NE(motor, settings.end());
  EXPECT_EQ(std::stod(argument(gains(), "--motor-inertia_kgm2")), std::get<double>(motor->value));
}

TEST(CommissionDesign, SetsOnlyKeysOfTheConfiguration) {
  const auto settings = measured_settings(measured(), kJoint, "table.json");
  const auto has = [&](const char* key) {
    return std::ranges::count(settings, key, &JointSetting::key) == 1;
  };
  for (const char* key : {"table", "load_inertia_kgm2", "stiffness_Nm_rad", "damping_Nms_rad",
                          "can.delay_periods", "control.gravity_Nm", "control.gravity_zero_rad"})
    EXPECT_TRUE(has(key)) << key;
  EXPECT_FALSE(has("resonance"));
}

TEST(CommissionDesign, LeavesGravityOutOfAHomedJoint) {
  JointToDesign homed = kJoint;
  homed.homed = true;
  for (const JointSetting& setting : measured_settings(measured(), homed, "table.json"))
    EXPECT_FALSE(setting.key.starts_with("control.")) << setting.key;
}

TEST(CommissionDesign, NamesTheNumberThatARecordLacks) {
  CommissionRecord record = measured();
  record.values.erase(record.values.begin() + 2);
  try {
    gains_arguments(record, kJoint, "friction.json", "table.json");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("stiffness_Nm_rad"), std::string::npos) << error.what();
  }
}

TEST(CommissionDesign, RefusesAJointWithoutAGearOfTheCatalogue) {
  const TemporaryFolder folder;
  const auto config = folder.path() / "arm.toml";
  write_text_file(config, "[[joint]]\nname = \"elbow\"\nmodel = \"rigid\"\n");
  EXPECT_THROW(read_joint_to_design(config, "elbow"), InputError);
  EXPECT_THROW(read_joint_to_design(config, "wrist"), InputError);
}

TEST(CommissionDesign, ReadsWhatTheShippedConfigurationSays) {
  const JointToDesign joint = read_joint_to_design(STRAINWAVE_SOURCE_DIR "/config/epos4.toml", "elbow");
  EXPECT_EQ(joint.gear, "csf-17-50");
  EXPECT_EQ(joint.joint_model, "rhs17-6006");
  EXPECT_TRUE(joint.homed);
  EXPECT_EQ(joint.prefix, "SW");
  EXPECT_EQ(joint.first_target_rad, 0.1);
}

}  // namespace
}  // namespace strainwave
