// SPDX-License-Identifier: BSD-3-Clause
#include "base/toml_section.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/printable.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& text, const std::function<void(TomlSection&)>& read) {
  return testing::refusal_of([&] {
    TomlSection section = TomlSection::parse(text, "a.toml");
    read(section);
    section.refuse_unknown_keys();
  });
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
            "a.toml:1: orders = false: one of \"refuse\", \"allow\" is allowed");
  EXPECT_EQ(refusal("orders = \"alow\"",
                    [](TomlSection& s) {
                      (void)s.choice("orders", {"refuse", "allow"});
                    }),
            "a.toml:1: orders = \"alow\": one of \"refuse\", \"allow\" is allowed; did you mean \"allow\"?");
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
  EXPECT_NE(refused_number("torque_Nm = 1\nx = 2").find("the keys here are torque_Nm. Physical"),
            std::string::npos);
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
    const std::string refused = testing::refusal_of([&] { (void)TomlSection::read(path); });
    EXPECT_NE(refused.find(path.string() + ": "), std::string::npos) << refused;
  }
  EXPECT_EQ(refusal("[joint\n", [](TomlSection&) {}).find("a.toml:1: not valid TOML"), 0U);
}

TEST(TomlSection, RefusesWhatNestsTooDeepBeforeItIsParsed) {
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  const auto ignore = [](TomlSection&) {};
  for (const std::string& deep :
       {"x = 1\n" + repeated("a.", 50'000) + "a = 1", "x = 1\n[" + repeated("a.", 50'000) + "a]",
        "x = 1\n" + repeated("\"a\" . ", 50'000) + "a = 1", "x = 1\na = " + repeated("[", 50'000),
        "x = 1\na = " + repeated("{a=", 50'000), "x = 1\na = " + repeated("{a.a.a.a=", 50'000),
        "x = '\"'\n" + repeated("'\u00e4'.", 50'000) + "a = 1",
        "x = 1 # \"\"\"\n" + repeated("a.", 50'000) + "a = 1"}) {
    const std::string said = refusal(deep, ignore);
    EXPECT_EQ(said.find("a.toml:2: tables are nested deeper than the allowed 32 levels"), 0U)
        << said.substr(0, 200);
  }
  EXPECT_NE(refusal(repeated("a.", 32) + "a = 1", ignore).find("unknown key"), std::string::npos);
}

TEST(TomlSection, CountsNoDotsOfStringsCommentsAndNumbers) {
  const std::string much = std::string(100, '.') + std::string(100, '[');
  const auto read = [](TomlSection& section) {
    for (const char* key : {"a", "b", "c", "d"}) (void)section.text(key);
    EXPECT_EQ(section.numbers("e", {0, 1}).size(), 40U);
  };
  std::string text = "# " + much + "\na = \"\\\"" + much + "\"\nb = '" + much + "'\nc = \"\"\"\"" + much +
                     "\n" + much + "\"\"\"\"\"\nd = '''" + much + "''" + much + "'''\ne = [";
  for (int i = 0; i < 40; ++i) text += "0.5, ";
  EXPECT_EQ(refusal(text + "]", read), "accepted");
}

TEST(TomlSection, ShowsNothingThatCommandsATerminal) {
  // An escape sequence, a reversed writing direction and a line break, in values and in keys.
  const std::string hostile = R"("\u001b[2J\u202e\nsound")";
  for (const std::string& text :
       {"torque_Nm = " + hostile, hostile + " = 1\ntorque_Nm = 1", "torque_Nm = 1\n[" + hostile + "]",
        std::string("torque_N = \"\x1b[2J\""), std::string("torque_N\u202e = 1")}) {
    const std::string said = refused_number(text);
    EXPECT_EQ(said, printable(said));
    EXPECT_NE(said, "accepted");
  }
  TomlSection section = TomlSection::parse("torque_Nm = " + hostile, "a.toml");
  section.warn("torque_Nm", "is doubtful");
  EXPECT_EQ(section.warnings().front(), "a.toml:1: torque_Nm = \"?[2J??sound\": is doubtful");
}

}  // namespace
}  // namespace strainwave
