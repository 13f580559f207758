// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/smooth_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

SmoothPath there_and_on() {
  SmoothPath path(0.1);
  path.move_to(0.5, 20.0);
  path.go_on(0.2);
  path.change_velocity(-0.3, 4.0);
  path.go_on(0.5);
  path.change_velocity(0.0, 4.0);
  return path;
}

TEST(SmoothPath, HasVelocityAndAccelerationThatAreThePositionsDerivatives) {
  const SmoothPath path = there_and_on();
  constexpr double kStep_s = 1e-5;
  for (double t = 0.0; t < path.end_s() + 0.1; t += 0.00137) {
    const Reference before = path.at(t - kStep_s);
    const Reference now = path.at(t);
    const Reference after = path.at(t + kStep_s);
    EXPECT_NEAR((after.position_rad - before.position_rad) / (2.0 * kStep_s), now.velocity_rad_s, 1e-5) << t;
    EXPECT_NEAR((after.velocity_rad_s - before.velocity_rad_s) / (2.0 * kStep_s), now.acceleration_rad_s2,
                0.05)
        << t;
  }
}

TEST(SmoothPath, UsesItsAccelerationAndNoMore) {
  const SmoothPath path = there_and_on();
  const auto largest = [&](double from_s, double to_s) {
    double most = 0.0;
    for (double t = from_s; t < to_s; t += 1e-4)
      most = std::max(most, std::abs(path.at(t).acceleration_rad_s2));
    return most;
  };
  EXPECT_NEAR(largest(0.0, 0.5), 20.0, 0.01);
  EXPECT_NEAR(largest(0.7, path.end_s()), 4.0, 0.01);
}

TEST(SmoothPath, RestsBeforeItBeginsAndAfterItEnds) {
  SmoothPath path(0.1);
  path.move_to(0.5, 20.0);
  for (const double t : {0.0, 0.1}) EXPECT_EQ(path.at(t).position_rad, 0.0);
  for (const double t : {path.end_s(), path.end_s() + 1.0}) {
    EXPECT_EQ(path.at(t).position_rad, 0.5);
    EXPECT_EQ(path.at(t).velocity_rad_s, 0.0);
  }
}

}  // namespace
}  // namespace strainwave
