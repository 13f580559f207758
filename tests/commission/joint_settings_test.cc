// SPDX-License-Identifier: BSD-3-Clause
#include "commission/joint_settings.h"

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "base/toml_section.h"

namespace strainwave {
namespace {

constexpr const char* kTwo = R"(# an arm
[daemon]
period_s = 0.001

[[joint]]
name = "wrist"
load_inertia_kgm2 = 0.1  # guessed

[joint.limits]
torque_limit_Nm = 10

# the second one
[[joint]]
name = "elbow"           # at the shoulder's end
load_inertia_kgm2 = 0.48 # 3 kg at 0.4 m
driver = "simulated"

[joint.limits]
torque_limit_Nm = 40     # a quarter of the gear's

# faults are elsewhere
)";

std::string set(const std::vector<JointSetting>& settings, const std::string& text = kTwo) {
  return with_settings(text, "elbow", settings, "arm.toml");
}

std::string without(std::string text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part << " is not in\n" << text;
  if (at != std::string::npos) text.erase(at, part.size());
  return text;
}

TEST(JointSettings, ReplaceAValueInItsLineAndChangeNoOther) {
  const std::string changed = set({{"load_inertia_kgm2", 0.52}});
  const std::string line = "load_inertia_kgm2 = 0.52  # before commissioning: 0.48\n";
  EXPECT_EQ(without(changed, line), without(kTwo, "load_inertia_kgm2 = 0.48 # 3 kg at 0.4 m\n"));
}

TEST(JointSettings, AddAKeyAtTheEndOfItsTable) {
  const std::string changed = set({{"table", "table.json"}, {"limits.load_Nm", 20.0}});
  EXPECT_NE(changed.find("driver = \"simulated\"\ntable = \"table.json\"\n\n[joint.limits]"),
            std::string::npos)
      << changed;
  EXPECT_NE(changed.find("a quarter of the gear's\nload_Nm = 20\n\n# faults"), std::string::npos) << changed;
}

TEST(JointSettings, AddATableThatTheJointHasNot) {
  const std::string changed = set({{"control.gravity_Nm", 11.8}, {"control.gravity_zero_rad", -0.5}});
  EXPECT_NE(changed.find("\n[joint.control]\ngravity_Nm = 11.8\ngravity_zero_rad = -0.5\n"),
            std::string::npos)
      << changed;
  TomlSection file = TomlSection::parse(changed, "changed");
  EXPECT_FALSE(file.sections("joint").front().has("control")) << "the other joint stays";
}

TEST(JointSettings, AreTheSameWhenTheyAreSetTwice) {
  const std::vector<JointSetting> settings{{"load_inertia_kgm2", 0.52}, {"control.gravity_Nm", 1.0}};
  const std::string once = set(settings);
  TomlSection file = TomlSection::parse(set(settings, once), "twice");
  EXPECT_EQ(file.sections("joint").size(), 2U);
}

TEST(JointSettings, RefuseAFileThatWritesTheJointInAnotherForm) {
  const std::string inline_table = "[[joint]]\nname = \"elbow\"\nlimits = { torque_limit_Nm = 40 }\n";
  try {
    set({{"limits.torque_limit_Nm", 30.0}}, inline_table);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("arm.toml"), std::string::npos) << error.what();
  }
  EXPECT_THROW(set({{"table", "table.json"}}, "joint = [{name = \"elbow\"}]\n"), InputError);
  EXPECT_THROW(set({{"table", "table.json"}}, "[[joint]]\nname = \"wrist\"\n"), InputError);
}

TEST(MovedPaths, BeginWithTheWayBackUnlessTheyAreAbsolute) {
  EXPECT_EQ(with_moved_paths("table = \"a.json\"  # \"b.json\"\nauthorized_keys = \"/etc/keys\"\n"
                             "friction = \"csf-25-100\"\nambient_temperature_C = \"csv:warm.csv\"\n"
                             "# table = \"c.json\"\nname = \"table\"\n",
                             "../"),
            "table = \"../a.json\"  # \"b.json\"\nauthorized_keys = \"/etc/keys\"\n"
            "friction = \"csf-25-100\"\nambient_temperature_C = \"csv:../warm.csv\"\n"
            "# table = \"c.json\"\nname = \"table\"\n");
  EXPECT_EQ(with_moved_paths("friction = \"own.json\"\n", "../"), "friction = \"../own.json\"\n");
}

}  // namespace
}  // namespace strainwave
