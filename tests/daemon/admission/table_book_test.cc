// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/table_book.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(TableBook, NeverOffersASlotThatTheLoopUsesOrMayReturnTo) {
  TableBook book;
  std::optional<std::size_t> active;
  std::optional<std::size_t> previous;
  for (int i = 0; i < 20; ++i) {
    const auto slot = book.free_slot();
    ASSERT_TRUE(slot);
    EXPECT_NE(slot, active);
    EXPECT_NE(slot, previous);
    book.begin(*slot);
    const bool accepted = i % 3 != 0;
    book.end(accepted);
    if (accepted) {
      previous = active;
      active = slot;
    }
    EXPECT_EQ(book.previous_slot(), previous);
  }
}

TEST(TableBook, OffersNothingWhileASwapIsUnderWay) {
  TableBook book;
  book.begin(*book.free_slot());
  EXPECT_TRUE(book.busy());
  EXPECT_FALSE(book.free_slot());
}

TEST(TableBook, GoesBackAndForthBetweenTheLastTwoTables) {
  TableBook book;
  const auto first = *book.free_slot();
  book.begin(first);
  book.end(true);
  const auto second = *book.free_slot();
  book.begin(second);
  book.end(true);
  ASSERT_EQ(book.previous_slot(), first);
  book.begin(first);
  book.end(true);
  EXPECT_EQ(book.previous_slot(), second);
}

}  // namespace
}  // namespace strainwave
