#include "control/friction_side.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kWidth_rad = 4e-5;

TEST(FrictionSide, TurnsRoundAtOnceWhereTheMotionGoesOn) {
  FrictionSide side(kWidth_rad);
  EXPECT_EQ(side.share(), 0.0);
  side.move(1e-9, 1e-3);
  EXPECT_EQ(side.share(), 1.0);
  side.move(-1e-9, -1e-3);
  EXPECT_EQ(side.share(), -1.0);
  side.move(1e-9, 4.0 * kWidth_rad);
  EXPECT_EQ(side.share(), 1.0);
}

TEST(FrictionSide, IsHardlyMovedByADither) {
  FrictionSide side(kWidth_rad);
  side.move(1e-9, 1e-3);
  for (int k = 0; k < 1000; ++k) {
    side.move(k % 2 == 0 ? -1e-6 : 1e-6, k % 2 == 0 ? -1e-6 : 1e-6);
    EXPECT_NEAR(side.share(), 1.0, 0.026);
  }
}

TEST(FrictionSide, TurnsRoundAfterTwiceItsWidthOfSlowMotion) {
  FrictionSide side(kWidth_rad);
  side.move(kWidth_rad, 0.0);
  EXPECT_EQ(side.share(), 1.0);
  for (int k = 0; k < 10; ++k) side.move(-0.1 * kWidth_rad, -kWidth_rad);
  EXPECT_NEAR(side.share(), 0.0, 1e-12);
  for (int k = 0; k < 11; ++k) side.move(-0.1 * kWidth_rad, -kWidth_rad);
  EXPECT_EQ(side.share(), -1.0);
}

// Who moves away from where the samples are has turned round there already.
TEST(FrictionSide, DoesNotTurnRoundAgainstWhereTheMotionGoes) {
  FrictionSide side(kWidth_rad);
  side.move(1e-9, 1e-3);
  side.move(-1e-9, 1e-3);
  EXPECT_NEAR(side.share(), 1.0, 1e-3);
}

TEST(FrictionSide, ForgetsWhenReset) {
  FrictionSide side(kWidth_rad);
  side.move(1.0, 1.0);
  side.reset();
  EXPECT_EQ(side.share(), 0.0);
}

}  // namespace
}  // namespace strainwave
