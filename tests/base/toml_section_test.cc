#include "base/toml_section.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& text, const std::function<void(TomlSection&)>& read) {
  try {
    TomlSection section = TomlSection::parse(text, "a.toml");
    read(section);
    section.refuse_unknown_keys();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refused_number(const std::string& text) {
  return refusal(text, [](TomlSection& section) { (void)section.number("torque_Nm", {0.0, 50.0}); });
}

TEST(TomlSection, NamesPlaceKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(refused_number("torque_Nm = 20"), "accepted");
  EXPECT_EQ(refused_number("\ntorque_Nm = 51.5"),
            "a.toml:2: torque_Nm = 51.5: a number from 0 to 50 is allowed");
  EXPECT_EQ(refused_number("torque_Nm = -0.089"),
            "a.toml:1: torque_Nm = -0.089: a number from 0 to 50 is allowed")
      << "printed with no more digits than it takes";
  EXPECT_EQ(refused_number("torque_Nm = nan"), "a.toml:1: torque_Nm = nan: a number from 0 to 50 is allowed");
  EXPECT_EQ(refused_number("torque_Nm = \"34\""),
            "a.toml:1: torque_Nm = \"34\": a number from 0 to 50 is allowed, without quotes");
  EXPECT_EQ(refused_number("[torque_Nm]"),
            "a.toml:1: torque_Nm = (a table): a number from 0 to 50 is allowed");
}

TEST(TomlSection, NamesWhatStandsInThePlaceOfAMissingKey) {
  EXPECT_EQ(refused_number("other = 1"), "a.toml:1: torque_Nm is missing: the key is required");
  EXPECT_EQ(
      refused_number("a = 1\ntorqe_Nm = 1"),
      "a.toml:1: torque_Nm is missing: the key is required; line 2 has torqe_Nm: is that what was meant?");
  EXPECT_EQ(refusal("[limit]\n", [](TomlSection& section) { (void)section.section("limits"); }),
            "a.toml:1: limits is missing: the key is required; line 1 has limit: is that what was meant?");
}

TEST(TomlSection, HasNoLineForATableThatStandsNowhere) {
  EXPECT_EQ(
      refusal("", [](TomlSection& section) { (void)section.section_or_empty("security").text("keys"); }),
      "a.toml: security.keys is missing: the key is required");
}

TEST(TomlSection, SaysWhichWordsAreAllowedForATruthValue) {
  EXPECT_EQ(refusal("orders = false",
                    [](TomlSection& s) {
                      (void)s.choice("orders", {"refuse", "allow"});
                    }),
            "a.toml:1: orders = false: allowed are \"refuse\", \"allow\"");
  EXPECT_EQ(refusal("orders = \"alow\"",
                    [](TomlSection& s) {
                      (void)s.choice("orders", {"refuse", "allow"});
                    }),
            "a.toml:1: orders = \"alow\": allowed are \"refuse\", \"allow\"; did you mean \"allow\"?");
}

TEST(TomlSection, WantsTwoBracketsForOneOfSeveral) {
  EXPECT_EQ(refusal("[joint]\nname = 1", [](TomlSection& section) { (void)section.sections("joint"); }),
            "a.toml:1: joint = (a table): one or more tables are allowed, each written [[joint]] with two "
            "brackets");
}

TEST(TomlSection, RefusesWhatNobodyAskedFor) {
  EXPECT_EQ(refused_number("torque_Nm = 1\ntorque = 2"),
            "a.toml:2: torque = 2: unknown key; did you mean torque_Nm? Physical quantities carry their unit "
            "in the key.");
  EXPECT_NE(refused_number("torque_Nm = 1\nx = 2").find("known here are: torque_Nm"), std::string::npos);
}

TEST(TomlSection, OutlivesNothingThatItRefersTo) {
  std::vector<TomlSection> joints =
      TomlSection::parse("[[joint]]\nname = \"a\"\n[[joint]]\nname = \"b\"\n", "a.toml").sections("joint");
  ASSERT_EQ(joints.size(), 2U);
  EXPECT_EQ(joints[1].text("name"), "b") << "a section keeps its document";
  EXPECT_EQ(joints[1].full_name("name"), "joint[1].name");
}

TEST(TomlSection, SaysWhatIsNoFile) {
  const TemporaryFolder folder;
  for (const auto& path : {folder.path(), folder.path() / "absent.toml"}) {
    try {
      (void)TomlSection::read(path);
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string() + ": "), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(refusal("[joint\n", [](TomlSection&) {}).find("a.toml:1: not valid TOML"), 0U);
}

}  // namespace
}  // namespace strainwave
