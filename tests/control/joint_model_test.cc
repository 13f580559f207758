#include "control/joint_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

JointModel model() {
  return {0.089, {4.4, 3.6, 2.3}, {0.042, 2.0}};
}

TEST(JointModel, StaysAtRestExactlyWhileTheTorqueIsBelowStaticFriction) {
  const JointDisturbance none;
  EXPECT_FALSE(model().advance(4.39, none, 0.0, 0.001).moved);
  EXPECT_FALSE(model().advance(-4.39, none, 0.0, 0.001).moved);
  EXPECT_TRUE(model().advance(4.41, none, 0.0, 0.001).moved);
  EXPECT_GT(model().advance(4.41, none, 0.0, 0.001).displacement_rad, 0.0);
  EXPECT_LT(model().advance(-4.41, none, 0.0, 0.001).displacement_rad, 0.0);
}

TEST(JointModel, ALoadShiftsTheTorqueThatItTakesToMove) {
  const JointDisturbance load{0.0, 2.0};
  EXPECT_FALSE(model().advance(6.3, load, 0.0, 0.001).moved);
  EXPECT_TRUE(model().advance(6.5, load, 0.0, 0.001).moved);
  EXPECT_FALSE(model().advance(-2.3, load, 0.0, 0.001).moved);
  EXPECT_TRUE(model().advance(-2.5, load, 0.0, 0.001).moved);
}

TEST(JointModel, StopsWithinThePeriodAndDoesNotTurnRoundByFrictionAlone) {
  const ModelMotion motion = model().advance(0.0, {}, 0.01, 0.001);
  EXPECT_EQ(motion.velocity_rad_s, 0.0);
  EXPECT_GT(motion.displacement_rad, 0.0);
}

TEST(JointModel, FrictionAlongAMotionOpposesEitherWayForAsLongAsItLasts) {
  const JointModel joint = model();
  EXPECT_EQ(joint.friction_along_Nm(0.0, 0.0), 0.0);
  EXPECT_EQ(joint.friction_along_Nm(0.3, 0.5), joint.friction_Nm(0.4));
  EXPECT_EQ(joint.friction_along_Nm(-0.3, -0.5), -joint.friction_Nm(0.4));
  EXPECT_EQ(joint.friction_along_Nm(0.2, -0.2), 0.0) << "half of the time each way";
  EXPECT_EQ(joint.friction_along_Nm(0.3, -0.1), -joint.friction_along_Nm(-0.3, 0.1));
  EXPECT_NEAR(joint.friction_along_Nm(0.3, -0.1),
              0.75 * joint.friction_Nm(0.15) - 0.25 * joint.friction_Nm(0.05), 1e-12);
  EXPECT_NEAR(joint.friction_along_Nm(0.3, -1e-12), joint.friction_along_Nm(0.3, 1e-12), 1e-9) << "no jump";
}

TEST(JointModel, ItsDerivativesAreThoseOfItsMotion) {
  const double step = 1e-6;
  for (const double velocity_rad_s : {-3.0, -0.5, 0.2, 4.0}) {
    const ModelMotion here = model().advance(10.0, {}, velocity_rad_s, 0.001);
    const ModelMotion beside = model().advance(10.0, {}, velocity_rad_s + step, 0.001);
    EXPECT_NEAR(here.velocity_by_velocity, (beside.velocity_rad_s - here.velocity_rad_s) / step, 3e-2);
    EXPECT_NEAR(here.displacement_by_velocity, (beside.displacement_rad - here.displacement_rad) / step,
                2e-5);
    const ModelMotion loaded = model().advance(10.0, {0.0, step}, velocity_rad_s, 0.001);
    EXPECT_NEAR(here.velocity_by_load, (loaded.velocity_rad_s - here.velocity_rad_s) / step, 5e-4);
  }
}

}  // namespace
}  // namespace strainwave
