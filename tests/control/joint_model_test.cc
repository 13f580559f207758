// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

TEST(JointModel, FrictionAlongAMotionOpposesEitherWayForAsLongAsItLasts) {
  const JointModel joint = testing::reference_model();
  EXPECT_EQ(joint.friction_along_Nm(0.0, 0.0), 0.0);
  EXPECT_EQ(joint.friction_along_Nm(0.3, 0.5), joint.friction_Nm(0.4));
  EXPECT_EQ(joint.friction_along_Nm(-0.3, -0.5), -joint.friction_Nm(0.4));
  EXPECT_EQ(joint.friction_along_Nm(0.2, -0.2), 0.0) << "half of the time each way";
  EXPECT_EQ(joint.friction_along_Nm(0.3, -0.1), -joint.friction_along_Nm(-0.3, 0.1));
  EXPECT_NEAR(joint.friction_along_Nm(0.3, -0.1),
              0.75 * joint.friction_Nm(0.15) - 0.25 * joint.friction_Nm(0.05), 1e-12);
  EXPECT_NEAR(joint.friction_along_Nm(0.3, -1e-12), joint.friction_along_Nm(0.3, 1e-12), 1e-9) << "no jump";
}

}  // namespace
}  // namespace strainwave
