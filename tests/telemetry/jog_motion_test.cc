// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/jog_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr JogLimits kLimits{-1.0, 2.0, 0.4, 1.5};
constexpr double kStep_s = 0.02;

/// Steps for `seconds` and expects every step within the limits.
void run(JogMotion& jog, double wanted_rad_s, double seconds) {
  for (double t_s = 0.0; t_s < seconds; t_s += kStep_s) {
    const double before_rad = jog.position_rad();
    const double before_rad_s = jog.velocity_rad_s();
    jog.step(wanted_rad_s, kStep_s);
    ASSERT_GE(jog.position_rad(), kLimits.position_min_rad);
    ASSERT_LE(jog.position_rad(), kLimits.position_max_rad);
    ASSERT_LE(std::abs(jog.velocity_rad_s()), kLimits.speed_rad_s);
    ASSERT_LE(std::abs(jog.position_rad() - before_rad), kLimits.speed_rad_s * kStep_s * (1.0 + 1e-9));
    // Near the end of the range a step may brake harder than the acceleration limit.
    ASSERT_LE(std::abs(jog.velocity_rad_s() - before_rad_s), 3.0 * kLimits.acceleration_rad_s2 * kStep_s);
  }
}

TEST(JogMotion, ReachesItsSpeedWithinTheAcceleration) {
  JogMotion jog(0.0, kLimits);
  jog.step(0.3, kStep_s);
  EXPECT_NEAR(jog.velocity_rad_s(), kLimits.acceleration_rad_s2 * kStep_s, 1e-12);
  run(jog, 0.3, 1.0);
  EXPECT_NEAR(jog.velocity_rad_s(), 0.3, 1e-12);
}

TEST(JogMotion, IsNeverFasterThanAllowed) {
  JogMotion jog(0.0, kLimits);
  run(jog, -100.0, 1.0);
  EXPECT_NEAR(jog.velocity_rad_s(), -kLimits.speed_rad_s, 1e-12);
}

TEST(JogMotion, ComesToRestAtTheEndsOfTheRange) {
  JogMotion jog(0.0, kLimits);
  run(jog, 0.4, 10.0);
  EXPECT_NEAR(jog.position_rad(), kLimits.position_max_rad, 1e-3);
  run(jog, -0.4, 20.0);
  EXPECT_NEAR(jog.position_rad(), kLimits.position_min_rad, 1e-3);
}

TEST(JogMotion, BeginsInsideTheRange) {
  EXPECT_EQ(JogMotion(2.01, kLimits).position_rad(), 2.0);
}

// The daemon refuses velocities that contradict positions.
TEST(JogMotion, HasAVelocityThatIsTheSlopeOfItsPositions) {
  JogMotion jog(0.0, kLimits);
  for (int i = 0; i < 100; ++i) {
    const double before_rad = jog.position_rad();
    const double before_rad_s = jog.velocity_rad_s();
    jog.step(0.25, kStep_s);
    EXPECT_NEAR((jog.position_rad() - before_rad) / kStep_s, 0.5 * (before_rad_s + jog.velocity_rad_s()),
                1e-9);
  }
}

}  // namespace
}  // namespace strainwave
