// SPDX-License-Identifier: BSD-3-Clause
#include "transport/fair_places.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(FairPlaces, BelongToWhoSpokeANameFirst) {
  FairPlaces<int> places(2);
  const LcmSource first{1, 1};
  const LcmSource second{2, 1};
  EXPECT_FALSE(places.take(10, first, 0.0));
  EXPECT_FALSE(places.take(11, first, 1.0));
  EXPECT_FALSE(places.take(10, second, 2.0)) << "heard from another, it stays the first's";
  EXPECT_EQ(places.take(20, second, 3.0), 11) << "of the first's two the one that was silent longer";
  places.leave(10);
  EXPECT_FALSE(places.take(21, second, 4.0)) << "who left gave room";
  EXPECT_EQ(places.take(12, first, 5.0), 20);
}

}  // namespace
}  // namespace strainwave
