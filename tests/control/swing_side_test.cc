#include "control/swing_side.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kNear_rad = 4e-4;

TEST(SwingSide, CountsEachTimeThatTheJointComesOver) {
  SwingSide side(kPeriod_s);
  EXPECT_FALSE(side.swings_over(1e-3, kNear_rad)) << "it came from nowhere";
  EXPECT_FALSE(side.swings_over(2e-3, kNear_rad));
  EXPECT_TRUE(side.swings_over(-1e-3, kNear_rad));
  EXPECT_FALSE(side.swings_over(-2e-3, kNear_rad)) << "in one period only";
  EXPECT_FALSE(side.swings_over(0.0, kNear_rad));
  EXPECT_TRUE(side.swings_over(1e-3, kNear_rad)) << "through the middle";
}

TEST(SwingSide, IsNoneOfAJointThatOnlyComesNear) {
  SwingSide side(kPeriod_s);
  side.swings_over(1e-3, kNear_rad);
  for (int k = 0; k < 20; ++k) EXPECT_FALSE(side.swings_over(k % 2 == 0 ? -kNear_rad : kNear_rad, kNear_rad));
}

TEST(SwingSide, IsForgottenOnceTheJointHasBeenNearForATenthOfASecond) {
  const auto comes_over_after = [](int near_periods) {
    SwingSide side(kPeriod_s);
    side.swings_over(1e-3, kNear_rad);
    for (int k = 0; k < near_periods; ++k) side.swings_over(0.0, kNear_rad);
    return side.swings_over(-1e-3, kNear_rad);
  };
  EXPECT_TRUE(comes_over_after(95));
  EXPECT_FALSE(comes_over_after(105));
}

}  // namespace
}  // namespace strainwave
