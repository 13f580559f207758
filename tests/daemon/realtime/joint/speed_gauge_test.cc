// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/speed_gauge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;
constexpr double kCount_rad = 2e-5;

double counted(double position_rad) {
  return kCount_rad * std::round(position_rad / kCount_rad);
}

TEST(SpeedGauge, MeasuresASteadySpeedThroughTheEncodersCounts) {
  for (const double velocity_rad_s : {0.02, -0.5, 3.6}) {
    SpeedGauge gauge;
    for (std::int64_t i = 0; i < 300; ++i) {
      gauge.see(counted(velocity_rad_s * 0.001 * static_cast<double>(i)), i * kStep_ns);
      if (i < 50) continue;
      EXPECT_NEAR(gauge.velocity_rad_s(), velocity_rad_s, kCount_rad / 0.05) << i;
    }
  }
}

TEST(SpeedGauge, TakesAFlickeringCountForNoMotion) {
  SpeedGauge gauge;
  for (std::int64_t i = 0; i < 500; ++i) {
    gauge.see(i % 3 == 0 ? kCount_rad : 0.0, i * kStep_ns);
    if (i < 50) continue;
    EXPECT_LT(std::abs(gauge.velocity_rad_s()), 0.001);
  }
}

TEST(SpeedGauge, KnowsATenthOfASecondAfterItThatAJointHasStopped) {
  SpeedGauge gauge;
  for (std::int64_t i = 0; i < 200; ++i) gauge.see(0.003 * static_cast<double>(i), i * kStep_ns);
  for (std::int64_t i = 200; i < 305; ++i) gauge.see(0.6, i * kStep_ns);
  EXPECT_EQ(gauge.velocity_rad_s(), 0.0);
}

TEST(SpeedGauge, ForgetsWhatWasBeforeSomebodyControlledTheJoint) {
  SpeedGauge gauge;
  for (std::int64_t i = 0; i < 200; ++i) gauge.see(0.0, i * kStep_ns);
  gauge.forget();
  gauge.see(3.0, 5000 * kStep_ns);
  EXPECT_EQ(gauge.velocity_rad_s(), 0.0);
}

}  // namespace
}  // namespace strainwave
