// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace strainwave {
namespace {

TEST(Friction, IsOddInVelocityToTheBit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  const FrictionParameters friction{4.4, 3.6, 2.3};
  for (const double shape : {0.5, 1.0, 2.0, 3.7})
    for (int trial = 0; trial < 500; ++trial) {
      const double velocity_rad_s = std::pow(10.0, exponent(random));
      EXPECT_EQ(stribeck_friction_Nm(friction, {0.042, shape}, velocity_rad_s),
                -stribeck_friction_Nm(friction, {0.042, shape}, -velocity_rad_s));
    }
  EXPECT_EQ(stribeck_friction_Nm(friction, {0.042, 2.0}, 0.0), 0.0);
}

TEST(Friction, BeginsWithStaticFrictionAndBecomesCoulombPlusViscous) {
  const FrictionParameters friction{4.4, 3.6, 2.3};
  const StribeckShape shape{0.042, 2.0};
  EXPECT_DOUBLE_EQ(stribeck_friction_Nm(friction, shape, std::numeric_limits<double>::denorm_min()), 4.4);
  EXPECT_DOUBLE_EQ(stribeck_friction_Nm(friction, shape, 1.0), 3.6 + 2.3);
}

TEST(Friction, TheTemperatureLawFallsWithWarmthAndIsNeverNegative) {
  const ExponentialTemperatureLaw law{{1.5, 0.7, -0.5}, {3.0, 3.0, 2.0}, -10.0, 11.0};
  double last_Nm = std::numeric_limits<double>::infinity();
  for (double temperature_C = -60.0; temperature_C < 150.0; temperature_C += 1.0) {
    const FrictionParameters here = law.at(temperature_C);
    EXPECT_LT(here.static_Nm, last_Nm) << temperature_C;
    EXPECT_GE(here.viscous_Nms_rad, 0.0) << temperature_C;
    last_Nm = here.static_Nm;
  }
}

}  // namespace
}  // namespace strainwave
