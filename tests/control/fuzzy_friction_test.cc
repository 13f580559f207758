// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

FuzzyFriction shipped() {
  return read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json").friction;
}

TEST(FuzzyFriction, IsOddInVelocityAtEveryTemperature) {
  const FuzzyFriction friction = shipped();
  for (double temperature_C = -30.0; temperature_C < 80.0; temperature_C += 1.7) {
    const FrictionParameters blended = friction.blend(friction.weights(temperature_C));
    for (double velocity_rad_s = 1e-12; velocity_rad_s < 1e6; velocity_rad_s *= 3.0)
      EXPECT_EQ(friction.torque_Nm(blended, velocity_rad_s), -friction.torque_Nm(blended, -velocity_rad_s));
    EXPECT_EQ(friction.torque_Nm(blended, 0.0), 0.0);
  }
}

TEST(FuzzyFriction, AtACrawlItIsStaticFrictionAndAtSpeedCoulombPlusViscous) {
  const FuzzyFriction friction = shipped();
  const FrictionParameters parameters{4.4, 3.6, 2.3};
  const double crawl_share = friction.velocity.zero_weight(0.0);
  EXPECT_NEAR(friction.torque_Nm(parameters, 1e-9), crawl_share * 4.4 + (1.0 - crawl_share) * 3.6, 1e-6);
  EXPECT_NEAR(friction.torque_Nm(parameters, 5.0), 3.6 + 2.3 * 5.0, 1e-9);
}

}  // namespace
}  // namespace strainwave
