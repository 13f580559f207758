// SPDX-License-Identifier: BSD-3-Clause
#include "base/csv.h"

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::string message_of(const std::string& text) {
  return testing::refusal_of([&] { parse_csv(text, "file.csv"); });
}

TEST(Csv, ReadsCommentsHeaderAndNumbers) {
  const CsvTable table = parse_csv("# note\na, b\r\n1,2.5\n\n-3e-2, 4\n", "file.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.column("b"), 1u);
  EXPECT_EQ(table.rows[1][0], -0.03);
  EXPECT_EQ(table.line_numbers[1], 5);
}

TEST(Csv, NamesFileAndLineOfEveryDefect) {
  EXPECT_NE(message_of("a,b\n1,x\n").find("file.csv:2: b = \"x\""), std::string::npos);
  EXPECT_NE(message_of("a,b\n1\n").find("file.csv:2:"), std::string::npos);
  EXPECT_NE(message_of("a,b\n1,2,3\n").find("3 fields"), std::string::npos);
  EXPECT_NE(message_of("a,a\n1,2\n").find("occurs twice"), std::string::npos);
  for (const char* const bad : {"nan", "inf", "1e999", "1 2", "", "0x10", "1,"}) {
    EXPECT_NE(message_of(std::string("a,b\n1,") + bad + "\n"), "accepted") << bad;
  }
}

TEST(Csv, NamesDecimalCommasAndOtherSeparators) {
  EXPECT_NE(message_of("temperature_C;torque_Nm\n-10;11,5\n").find("file.csv:1: semicolons"),
            std::string::npos);
  EXPECT_NE(message_of("temperature_C\ttorque_Nm\n-10\t11.5\n").find("tabs"), std::string::npos);
  EXPECT_NE(message_of("temperature_C,torque_Nm\n-10,11,5\n").find("decimal comma"), std::string::npos);
  EXPECT_EQ(message_of("temperature_C,torque_Nm\n-10\n").find("decimal comma"), std::string::npos);
}

TEST(Csv, SaysHowToConvertAColumnInAnotherUnit) {
  const std::string refused = testing::refusal_of(
      [&] { (void)parse_csv("temperature_F,torque_Nm\n14,11\n", "file.csv").column("temperature_C"); });
  EXPECT_NE(refused.find("(degF - 32) / 1.8"), std::string::npos) << refused;
}

TEST(Csv, SaysOfWhatIsNoTextThatItIsNone) {
  const std::string words =
      "file.csv: is not a text file; a CSV file has lines of text with commas between the fields";
  EXPECT_EQ(message_of(std::string("\x7f"
                                   "ELF\0,\n1,2\n",
                                   11)),
            words);
  EXPECT_EQ(message_of(std::string("\xff\xfe"
                                   "a\0,\0b\0\n\0",
                                   10)),
            words)
      << "UTF-16";
  EXPECT_EQ(message_of("# \xb0"
                       "C of an older editor\r\na,\tb\r\n1,2\r\n"),
            "accepted");
}

TEST(Csv, RefusesFilesWithoutData) {
  EXPECT_NE(message_of(""), "accepted");
  EXPECT_NE(message_of("# only a note\n"), "accepted");
  EXPECT_NE(message_of("a,b\n"), "accepted");
}

TEST(Csv, OfAnotherHeaderWithManyColumnsTheBeginningIsQuoted) {
  std::string line = "a";
  for (int i = 0; i < 100; ++i) line += ",column" + std::to_string(i);
  const std::string text = testing::refusal_of([&] {
    parse_csv_text(line + "\n1" + std::string(100, ',') + "\n", "file.csv").require_columns({"a", "c"});
  });
  EXPECT_TRUE(text.starts_with("file.csv:1: header = a,column0,")) << text;
  EXPECT_TRUE(text.ends_with("...: must be 'a,c'")) << text;
  EXPECT_LT(text.size(), 150U);
}

TEST(Csv, AnotherHeaderIsNamedWithItsLine) {
  const std::string refused = testing::refusal_of([&] {
    parse_csv("# note\na,b\n1,2\n", "file.csv").require_columns({"a", "c"});
  });
  EXPECT_EQ(refused, "file.csv:2: header = a,b: must be 'a,c'");
  EXPECT_NO_THROW(parse_csv("\xEF\xBB\xBF"
                            "a,b\n1,2\n",
                            "file.csv")
                      .require_columns({"a", "b"}))
      << "a byte order mark";
}

TEST(Csv, AMissingColumnIsNamed) {
  EXPECT_THROW(parse_csv("a\n1\n", "file.csv").column("b"), InputError);
}

}  // namespace
}  // namespace strainwave
