// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/torsion_spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/joint/gear_catalogue.h"

namespace strainwave {
namespace {

TEST(TorsionSpring, IsContinuousOddAndItsOwnInverse) {
  const TorsionSpring spring = find_gear("csf-17-50")->spring;
  for (double angle_rad = -4e-3; angle_rad <= 4e-3; angle_rad += 1e-5) {
    EXPECT_EQ(spring.torque_Nm(angle_rad), -spring.torque_Nm(-angle_rad));
    EXPECT_NEAR(spring.angle_rad(spring.torque_Nm(angle_rad)), angle_rad, 1e-15);
    const double torque_Nm = spring.torque_Nm(angle_rad);
    EXPECT_NEAR((spring.angle_rad(torque_Nm + 1e-4) - spring.angle_rad(torque_Nm)) / 1e-4,
                spring.compliance_rad_Nm(torque_Nm + 5e-5), 1e-9);
    EXPECT_LE(std::abs(spring.torque_Nm(angle_rad + 1e-9) - spring.torque_Nm(angle_rad)), 1.4e4 * 1e-9);
  }
  EXPECT_NEAR(spring.angle_rad(10.0), 1.04e-3, 0.01e-3) << "the wind-up at 10 N.m";
}

}  // namespace
}  // namespace strainwave
