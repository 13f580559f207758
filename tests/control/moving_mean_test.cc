// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/moving_mean.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;

/// x = t^3. Its mean over the width w is (t^4 - (t - w)^4) / 4w.
MotionPoint cubic(double t) {
  return {t * t * t, 3.0 * t * t, 6.0 * t, 6.0};
}

TEST(MovingMean, IsTheIntegralOfACubicOverItsWidth) {
  MovingMean mean(7, kPeriod_s);
  MotionPoint result;
  for (int k = 0; k <= 100; ++k) result = mean.step(cubic(k * kPeriod_s));
  const double t = 0.1;
  const double w = 7.0 * kPeriod_s;
  EXPECT_NEAR(result.position_rad, (std::pow(t, 4) - std::pow(t - w, 4)) / (4.0 * w), 1e-15);
  EXPECT_NEAR(result.velocity_rad_s, (std::pow(t, 3) - std::pow(t - w, 3)) / w, 1e-13);
  EXPECT_NEAR(result.acceleration_rad_s2, 3.0 * (t * t - (t - w) * (t - w)) / w, 1e-11);
  EXPECT_NEAR(result.jerk_rad_s3, 6.0, 1e-9);
}

}  // namespace
}  // namespace strainwave
