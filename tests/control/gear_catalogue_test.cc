// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/gear_catalogue.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

TEST(GearCatalogue, KnowsEverySizeByNameAndStiffensWithTorqueAndSize) {
  double last_Nm_rad = 0.0;
  for (const char* name : {"csf-14-50", "csf-17-50", "csf-20-50", "csf-25-50", "csf-32-50"}) {
    const Gear* gear = find_gear(name);
    ASSERT_NE(gear, nullptr) << name;
    EXPECT_EQ(gear->ratio, 50.0);
    EXPECT_GT(gear->spring.stiffness_1_Nm_rad, last_Nm_rad);
    last_Nm_rad = gear->spring.stiffness_1_Nm_rad;
  }
  for (const Gear& gear : gear_catalogue()) {
    EXPECT_LT(gear.spring.stiffness_1_Nm_rad, gear.spring.stiffness_2_Nm_rad) << gear.name;
    EXPECT_LT(gear.spring.stiffness_2_Nm_rad, gear.spring.stiffness_3_Nm_rad) << gear.name;
    EXPECT_LT(gear.spring.torque_1_Nm, gear.spring.torque_2_Nm) << gear.name;
  }
  EXPECT_EQ(find_gear("csf-17-49"), nullptr);
}

}  // namespace
}  // namespace strainwave
