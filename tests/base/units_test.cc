// SPDX-License-Identifier: BSD-3-Clause
#include "base/units.h"

#include <gtest/gtest.h>

#include <limits>

namespace strainwave {
namespace {

// The gear of the source. The expected numbers come from a pocket calculator.
constexpr double kRatio = 50.0;

TEST(Units, AViscousTorqueIsTheSameWhetherItIsConvertedAsOneOrAsSpeedTimesCoefficient) {
  for (const double rpm : {1.0, 500.0, 3500.0}) {
    const double coefficient_Ncm_per_rpm = 0.0031;
    const double torque_Nm = joint_torque_Nm_from_motor_Ncm(coefficient_Ncm_per_rpm * rpm, kRatio);
    const double velocity_rad_s = joint_velocity_rad_s_from_motor_rpm(rpm, kRatio);
    EXPECT_NEAR(
        joint_viscous_Nms_rad_from_motor_Ncm_per_rpm(coefficient_Ncm_per_rpm, kRatio) * velocity_rad_s,
        torque_Nm, 1e-12 * torque_Nm);
  }
}

TEST(Units, TheSignOfNothingIsNothing) {
  EXPECT_EQ(sign(0.0), 0.0);
  EXPECT_EQ(sign(-0.0), 0.0);
  EXPECT_EQ(sign(std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_EQ(sign(std::numeric_limits<double>::denorm_min()), 1.0);
  EXPECT_EQ(sign(-std::numeric_limits<double>::infinity()), -1.0);
}

}  // namespace
}  // namespace strainwave
