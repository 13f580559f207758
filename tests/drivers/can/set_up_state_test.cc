// SPDX-License-Identifier: BSD-3-Clause
// The handshake between the background thread and the loop.
#include "drivers/can/set_up_state.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

/// Returns the periods until the loop uses a drive after its setup.
int periods_until_ready(SetUpState& setup) {
  for (int period = 1; period < 10; ++period)
    if (setup.look()) return period;
  return -1;
}

TEST(SetUpState, BeginsOnlyWhatWasRequestedAndOnlyOnce) {
  SetUpState setup;
  EXPECT_TRUE(setup.begin());
  EXPECT_FALSE(setup.begin());
  setup.end(true);
  EXPECT_FALSE(setup.begin());
  setup.request();
  EXPECT_TRUE(setup.begin());
}

TEST(SetUpState, IsReadyForTheLoopOnlyAPeriodAfterTheLoopHasSeenIt) {
  SetUpState setup;
  ASSERT_TRUE(setup.begin());
  EXPECT_FALSE(setup.look());
  setup.end(true);
  EXPECT_FALSE(setup.ready());
  EXPECT_FALSE(setup.look());
  EXPECT_FALSE(setup.ready());
  EXPECT_TRUE(setup.look());
  EXPECT_TRUE(setup.ready());
  EXPECT_FALSE(setup.look());
  EXPECT_TRUE(setup.ready());
}

TEST(SetUpState, ARequestTakesTheDriveFromTheLoopAtOnce) {
  SetUpState setup;
  setup.end(true);
  ASSERT_EQ(periods_until_ready(setup), 2);
  setup.request();
  EXPECT_FALSE(setup.ready());
  EXPECT_FALSE(setup.look());
  EXPECT_FALSE(setup.ready());
  ASSERT_TRUE(setup.begin());
  setup.end(true);
  EXPECT_EQ(periods_until_ready(setup), 2);
}

TEST(SetUpState, ARequestInThePeriodBetweenBeginsTheWaitAnew) {
  SetUpState setup;
  setup.end(true);
  EXPECT_FALSE(setup.look());
  setup.request();
  ASSERT_TRUE(setup.begin());
  setup.end(true);
  EXPECT_EQ(periods_until_ready(setup), 2);
}

TEST(SetUpState, ThatIsWornOutGoesOnAndMustBeRepeated) {
  SetUpState setup;
  setup.wear_out();
  EXPECT_FALSE(setup.must_be_repeated()) << "nothing there that could wear out";
  setup.end(true);
  ASSERT_EQ(periods_until_ready(setup), 2);
  EXPECT_FALSE(setup.must_be_repeated());
  setup.wear_out();
  EXPECT_TRUE(setup.ready());
  EXPECT_FALSE(setup.look());
  EXPECT_TRUE(setup.must_be_repeated());
  setup.request();
  EXPECT_FALSE(setup.must_be_repeated());
}

TEST(SetUpState, ThatFailedIsBegunAnewOnRequestAlone) {
  SetUpState setup;
  ASSERT_TRUE(setup.begin());
  setup.end(false);
  EXPECT_FALSE(setup.look());
  EXPECT_TRUE(setup.failed());
  EXPECT_TRUE(setup.must_be_repeated());
  EXPECT_FALSE(setup.begin());
  setup.request();
  EXPECT_FALSE(setup.failed());
  EXPECT_TRUE(setup.begin());
}

}  // namespace
}  // namespace strainwave
