// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_catalogue.h"

#include <gtest/gtest.h>

#include <numbers>

#include "control/joint/gear_catalogue.h"

namespace strainwave {
namespace {

constexpr double kRatio = 50.0;

TEST(JointCatalogue, HasTheCataloguesFrictionAtTheJointsSide) {
  const FrictionParameters warm = catalogue_joint().friction_at(40.0, kRatio);
  EXPECT_NEAR(warm.static_Nm, 2.9667 * 0.01 * 50.0, 1e-12);
  EXPECT_NEAR(warm.coulomb_Nm, 1.3667 * 0.01 * 50.0, 1e-12);
  EXPECT_NEAR(warm.viscous_Nms_rad, 0.00087619 * 0.01 * 60.0 / (2.0 * std::numbers::pi) * 2500.0, 1e-12);
  const FrictionParameters between = catalogue_joint().friction_at(38.75, kRatio);
  EXPECT_NEAR(between.static_Nm, 0.25 * (2.9667 + 3.0333), 1e-12);
  EXPECT_EQ(catalogue_joint().friction_at(95.0, kRatio).coulomb_Nm, warm.coulomb_Nm);
  EXPECT_EQ(catalogue_joint().friction_at(-60.0, kRatio).coulomb_Nm,
            catalogue_joint().friction_at(-10.0, kRatio).coulomb_Nm);
}

TEST(JointCatalogue, HasTheActuatorsOwnInertiaAndItsGear) {
  EXPECT_EQ(catalogue_joint().model, "rhs17-6006");
  EXPECT_EQ(catalogue_joint().motor_inertia_kgm2, 0.089) << "inertia_at_output of the data sheet";
  ASSERT_NE(find_gear(catalogue_joint().gear), nullptr);
  EXPECT_EQ(find_gear(catalogue_joint().gear)->ratio, kRatio) << "that of its friction's motor side";
}

}  // namespace
}  // namespace strainwave
