// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/ordered_target.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr OrderedTarget::Setpoint kMove{1.0, 1.0, 0, 0.0};
constexpr OrderedTarget::Setpoint kStreamed{1.0, 1.0, 7, 0.05};

TEST(OrderedTarget, OfAMoveNeverExpires) {
  OrderedTarget target;
  target.accept(kMove, 0);
  EXPECT_FALSE(target.streamed());
  EXPECT_EQ(target.stream_id(), 0);
  EXPECT_FALSE(target.expire(INT64_MAX));
  EXPECT_FALSE(target.shows_expiry());
}

TEST(OrderedTarget, OfAStreamExpiresOnceAtTheEndOfItsTime) {
  OrderedTarget target;
  target.accept(kStreamed, 0);
  EXPECT_TRUE(target.streamed());
  EXPECT_EQ(target.stream_id(), 7);
  EXPECT_FALSE(target.expire(50 * kMillisecond_ns - 1));
  EXPECT_TRUE(target.expire(50 * kMillisecond_ns));
  EXPECT_FALSE(target.expire(51 * kMillisecond_ns));
  EXPECT_FALSE(target.streamed());
  EXPECT_EQ(target.stream_id(), 0);
}

TEST(OrderedTarget, IsValidForTheTimeOfTheNewestSetpoint) {
  OrderedTarget target;
  for (std::int64_t sent_ms = 0; sent_ms < 1000; sent_ms += 10) {
    target.accept(kStreamed, sent_ms * kMillisecond_ns);
    EXPECT_FALSE(target.expire((sent_ms + 9) * kMillisecond_ns));
  }
  EXPECT_TRUE(target.expire((990 + 50) * kMillisecond_ns));
}

TEST(OrderedTarget, OfAPathGoesOnWithoutATimeUntilSomethingEndsIt) {
  OrderedTarget target;
  target.begin_path(0.5, 0.7);
  EXPECT_TRUE(target.on_path());
  EXPECT_TRUE(target.goes_on());
  EXPECT_FALSE(target.streamed());
  EXPECT_FALSE(target.expire(INT64_MAX));
  EXPECT_FALSE(target.takes(7, false)) << "a setpoint of a stream is none of the path's";
  EXPECT_EQ(target.shown_rad(0.7, JointZero(false)), 0.5);
  target.end();
  EXPECT_FALSE(target.on_path());
  target.begin_path(0.5, 0.7);
  target.accept(kMove, 0);
  EXPECT_FALSE(target.goes_on());
}

TEST(OrderedTarget, TakesOfStreamsOnlyTheFirstSetpointAndThatWhichIsUnderWay) {
  OrderedTarget target;
  EXPECT_FALSE(target.takes(7, false)) << "nobody has begun it";
  EXPECT_TRUE(target.takes(7, true));
  target.accept(kStreamed, 0);
  EXPECT_TRUE(target.takes(7, false));
  EXPECT_FALSE(target.takes(8, false));
  EXPECT_TRUE(target.takes(8, true)) << "another may begin";
  EXPECT_TRUE(target.takes(0, false)) << "a move always";
}

TEST(OrderedTarget, RefusesWhatComesLateOfAStreamHoweverItEnded) {
  for (int end = 0; end < 4; ++end) {
    OrderedTarget target;
    target.accept(kStreamed, 0);
    if (end == 0) {
      ASSERT_TRUE(target.expire(50 * kMillisecond_ns));
    }
    if (end == 1) target.end();
    if (end == 2) target.forget();
    if (end == 3) target.accept(kMove, 1);
    EXPECT_FALSE(target.takes(7, false)) << end;
    EXPECT_FALSE(target.streamed()) << end;
    EXPECT_TRUE(target.takes(7, true)) << end;
  }
}

TEST(OrderedTarget, ShowsAnExpiryUntilTheNextSetpointAndNoOtherEnd) {
  OrderedTarget target;
  target.accept(kStreamed, 0);
  ASSERT_TRUE(target.expire(50 * kMillisecond_ns));
  target.end();
  EXPECT_TRUE(target.shows_expiry()) << "a hold after it";
  target.accept(kStreamed, 60 * kMillisecond_ns);
  EXPECT_FALSE(target.shows_expiry());
  target.end();
  EXPECT_FALSE(target.expire(INT64_MAX));
  EXPECT_FALSE(target.shows_expiry());
  target.accept(kStreamed, 0);
  ASSERT_TRUE(target.expire(INT64_MAX));
  target.forget();
  EXPECT_FALSE(target.shows_expiry()) << "the joint was enabled anew";
}

TEST(OrderedTarget, IsShownToTheBitAsItWasOrderedAlsoAfterTheZeroHasMoved) {
  JointZero zero(true);
  zero.set(0.1, 0.3);
  OrderedTarget target;
  const double ordered_rad = 0.7;
  const double drive_rad = zero.to_drive_rad(ordered_rad);
  target.accept({ordered_rad, drive_rad, 0, 0.0}, 0);
  EXPECT_EQ(target.shown_rad(drive_rad, zero), ordered_rad);
  EXPECT_DOUBLE_EQ(target.shown_rad(0.25, zero), 0.45) << "the controller has another one by now";
  zero.set(0.1, 0.5);
  target.rezero(zero);
  EXPECT_DOUBLE_EQ(target.shown_rad(drive_rad, zero), 0.9);
}

TEST(OrderedTarget, OfAPathThatEndsEarlyIsOnItUntilItIsOver) {
  OrderedTarget target;
  target.path_ends();
  EXPECT_FALSE(target.ends_path()) << "there is none";
  target.begin_path(1.0, 1.0);
  EXPECT_FALSE(target.ends_path());
  target.path_ends();
  EXPECT_TRUE(target.ends_path());
  EXPECT_TRUE(target.on_path());
  EXPECT_TRUE(target.goes_on());
  target.end();
  EXPECT_FALSE(target.ends_path());
  EXPECT_FALSE(target.on_path());
}

}  // namespace
}  // namespace strainwave
