// SPDX-License-Identifier: BSD-3-Clause
#include "base/printable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace strainwave {
namespace {

TEST(Printable, KeepsTextAndDropsWhatCommandsATerminal) {
  EXPECT_EQ(printable("position 2 rad: allowed -1 to 1"), "position 2 rad: allowed -1 to 1");
  EXPECT_EQ(printable("a\x1b[2Jb\r\nc\x7f"), "a?[2Jb??c?");
  EXPECT_EQ(printable("5 \xC2\xB0"
                      "C"),
            "5 \xC2\xB0"
            "C");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J")
                .find('\x9B'),
            std::string::npos);
}

TEST(Printable, ShowsNoTextInAnotherOrderThanItIs) {
  // U+202E reverses the writing direction, U+2028 begins a line, U+200B and U+FEFF are invisible.
  EXPECT_EQ(printable("elbow\u202Edelbasid"), "elbow?delbasid");
  EXPECT_EQ(printable("a\u2028b\u200Bc\uFEFFd\u2066e"), "a?b?c?d?e");
  EXPECT_EQ(printable("a\u115Fb\u3164c\uFFA0d"), "a?b?c?d");
  EXPECT_EQ(printable("\u00C4rmel \u2013 \u65E5\u672C \U0001F916"),
            "\u00C4rmel \u2013 \u65E5\u672C \U0001F916");
}

TEST(Printable, LetsNoTextPassForALineOfTheProgram) {
  EXPECT_EQ(printable_paragraph("x\nstrainwaved: sound\n\x1b[2J"), "x\n  strainwaved: sound\n  ?[2J");
}

TEST(ShellWord, IsReadBackByAShell) {
  EXPECT_EQ(shell_word("elbow/elbow.toml"), "elbow/elbow.toml");
  for (const char* word :
       {"", "my joint/elbow.toml", "it's; $HOME `ls` \\ \"a\" *", "a\nb", "~", "#no", "a&b"}) {
    const std::string command = "printf %s " + shell_word(word);
    std::string read;
    FILE* const shell = ::popen(command.c_str(), "r");
    ASSERT_NE(shell, nullptr);
    for (int letter = std::fgetc(shell); letter != EOF; letter = std::fgetc(shell))
      read += static_cast<char>(letter);
    EXPECT_EQ(::pclose(shell), 0);
    EXPECT_EQ(read, word);
  }
}

TEST(Printable, TakesNothingForTextThatIsNoUtf8) {
  // Byte 9Bh, which eight-bit terminals obey; then an overlong escape, a lone surrogate, a truncated sequence.
  EXPECT_EQ(printable("a\x9B"
                      "2J"),
            "a?2J");
  EXPECT_EQ(printable("\xC0\x9B[2J"), "??[2J");
  EXPECT_EQ(printable("\xED\xA0\x80."), "???.");
  EXPECT_EQ(printable("\xE2\x80"), "??");
  EXPECT_EQ(printable("\xFF\xFE\xF8\x88\x80\x80\x80"), "???????");
}

// Ten times 0.089 is 0.8899999999999999.
TEST(Printable, PrintsABoundSoThatWhoGivesItIsNotBeyondIt) {
  EXPECT_EQ(bound_text(10.0 * 0.089), "0.89");
  EXPECT_EQ(beyond_text(0.8901, 10.0 * 0.089), "0.8901");
  EXPECT_EQ(beyond_text(0.8900001, 10.0 * 0.089), "0.8900001");
  EXPECT_EQ(beyond_text(38.199999999999996, 30.0), "38.2");
  EXPECT_EQ(bound_text(6.2831853), "6.2831853");
  for (const double bound : {2.0 / 3.0, -3.2, 1e-7 / 3.0, 1e9 / 7.0, 0.0}) {
    EXPECT_LE(std::abs(std::stod(bound_text(bound)) - bound), 0.1 * kAtBound * std::abs(bound)) << bound;
    const double beyond = bound * (1.0 + 2.0 * kAtBound) + (bound == 0.0 ? 1e-12 : 0.0);
    EXPECT_NE(beyond_text(beyond, bound), bound_text(bound)) << bound;
  }
}

TEST(Printable, CountsOneThingAsOne) {
  EXPECT_EQ(counted(1, "knot"), "1 knot");
  EXPECT_EQ(counted(0, "knot"), "0 knots");
  EXPECT_EQ(counted(-1, "state"), "-1 states");
}

TEST(Printable, StopsAtTheFirstZeroByte) {
  EXPECT_EQ(printable(std::string("ab\0cd", 5)), "ab");
}

}  // namespace
}  // namespace strainwave
