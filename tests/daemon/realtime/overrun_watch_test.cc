#include "daemon/realtime/overrun_watch.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(OverrunWatch, SpeaksAtTheLimitOfLateCyclesInARowAndBeginsAnew) {
  OverrunWatch watch(3);
  for (int round = 0; round < 4; ++round) {
    EXPECT_FALSE(watch.too_many(1));
    EXPECT_FALSE(watch.too_many(1));
    EXPECT_TRUE(watch.too_many(1));
  }
}

TEST(OverrunWatch, BeginsAnewWithACycleInTime) {
  OverrunWatch watch(3);
  for (int round = 0; round < 100; ++round) {
    EXPECT_FALSE(watch.too_many(1));
    EXPECT_FALSE(watch.too_many(1));
    EXPECT_FALSE(watch.too_many(0));
  }
}

}  // namespace
}  // namespace strainwave
