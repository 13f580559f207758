// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/ordered_target.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr OrderedTarget::Setpoint kMove{1.0, 1.0, 0, 0.0};
constexpr OrderedTarget::Setpoint kStreamed{1.0, 1.0, 7, 0.05};

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

TEST(OrderedTarget, IsShownToTheBitAsItWasOrderedUntilTheZeroMayMove) {
  JointZero zero(true);
  zero.set(0.1, 0.3);
  OrderedTarget target;
  const double ordered_rad = 0.7;
  const double drive_rad = zero.to_drive_rad(ordered_rad);
  target.accept({ordered_rad, drive_rad, 0, 0.0}, 0);
  EXPECT_EQ(target.shown_rad(drive_rad, zero), ordered_rad);
  EXPECT_DOUBLE_EQ(target.shown_rad(0.25, zero), 0.45) << "the controller has another one by now";
  target.forget();
  zero.set(0.1, 0.5);
  EXPECT_DOUBLE_EQ(target.shown_rad(drive_rad, zero), 0.9);
}

}  // namespace
}  // namespace strainwave
