// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/screen.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(WatchScreen, KeepsCharactersOfSeveralBytesInOneCell) {
  Screen screen(1, 4);
  EXPECT_EQ(screen.put(0, 1, "a█b█"), 5);
  EXPECT_EQ(screen.text(0), " a█b");
  EXPECT_EQ(screen.at(0, 2).glyph, "█");
  EXPECT_EQ(Screen(-1, -1).rows(), 0);
}

}  // namespace
}  // namespace strainwave
