#include "base/printable.h"

#include <gtest/gtest.h>

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

TEST(Printable, StopsAtTheFirstZeroByte) {
  EXPECT_EQ(printable(std::string("ab\0cd", 5)), "ab");
}

}  // namespace
}  // namespace strainwave
