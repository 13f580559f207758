// SPDX-License-Identifier: BSD-3-Clause
#include "base/strict_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& text) {
  return testing::refusal_of([&] {
    const auto document = parse_strict_json(text, "a.json");
    StrictObject object(document, "a.json");
    (void)object.number("torque_Nm");
    object.finish();
  });
}

TEST(StrictJson, RefusesWhatNestsTooDeepForWhoeverWalksThroughIt) {
  const std::string open(1'000'000, '[');
  EXPECT_EQ(refusal("{\"torque_Nm\": " + open + std::string(1'000'000, ']') + "}"),
            "a.json: lists and objects are nested deeper than the allowed 32 levels");
  EXPECT_EQ(refusal("{\"torque_Nm\": 1, \"torque\": 2}"), "a.json: torque: unknown key");
}

TEST(StrictJson, SaysWhereReadingStoppedAndWhatStandsThere) {
  EXPECT_EQ(refusal(""), "a.json: is empty: JSON is expected, an object in braces");
  EXPECT_EQ(refusal(std::string("{}\0{}", 5)), "a.json: not valid JSON: byte 3 is a zero");
  EXPECT_EQ(refusal("\n speed_rpm,torque\n"),
            "a.json: not valid JSON: the file begins with 'speed_rpm,torque', but must begin with {");
  EXPECT_EQ(refusal("{\n  \"torque_Nm\": 1,\n}"),
            "a.json:3: not valid JSON: unexpected character in column 1 of '}'");
  EXPECT_EQ(refusal("{\"torque_Nm\": 0x1}"),
            "a.json:1: not valid JSON: unexpected character in column 16 of '{\"torque_Nm\": 0x1}'");
  for (const char* const number : {"0,001", "10,356", "-2,5e3"})
    EXPECT_NE(refusal(std::string("{\"torque_Nm\": ") + number + "}").find("a decimal point"),
              std::string::npos)
        << number;
  EXPECT_EQ(refusal("{\"torque_Nm\": 1"),
            "a.json:1: not valid JSON: the file ends before every brace, bracket and quote is closed");
  EXPECT_EQ(refusal("{\"torque_Nm\": 1e999}"), "a.json: not valid JSON: number overflow parsing '1e999'");
}

TEST(StrictJson, ShowsNothingThatCommandsATerminal) {
  const std::string hostile = R"("\u001b[2J\u202e\nsound")";
  for (const std::string& text :
       {"{\"torque_Nm\": " + hostile + "}", "{\"torque_Nm\": 1, " + hostile + ": 1}",
        "{" + hostile + ": 1, " + hostile + ": 1}", std::string("{\"torque_Nm\": \u202e"),
        "{" + hostile + ": 1}"}) {
    const std::string said = refusal(text);
    EXPECT_EQ(said, printable(said));
    EXPECT_NE(said, "accepted");
  }
}

}  // namespace
}  // namespace strainwave
