#include "control/landing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kCount_rad = 2e-5;

JointModel model() {
  return {0.089, {4.4, 3.6, 2.3}, {0.042, 2.0}, 1.6};
}

TEST(Landing, ItsPushEndsWhereItIsMeantTo) {
  for (const double distance_rad : {2e-6, 1e-5, 4e-5, -2e-5}) {
    const JointModel joint = model();
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
    for (int k = 0; k < 12; ++k) {
      const double torque_Nm =
          landing_torque_Nm(joint, {}, velocity_rad_s, distance_rad - position_rad, 0.001);
      const ModelMotion motion = joint.advance(torque_Nm, {}, velocity_rad_s, 0.001);
      position_rad += motion.displacement_rad;
      velocity_rad_s = motion.velocity_rad_s;
    }
    EXPECT_NEAR(position_rad, distance_rad, 0.02 * std::abs(distance_rad));
    EXPECT_EQ(velocity_rad_s, 0.0);
  }
}

TEST(Landing, OnTheTargetThePushIsWhatHoldsTheLoad) {
  EXPECT_EQ(landing_torque_Nm(model(), {0.3, -2.5}, 0.0, 0.0, 0.001), -2.5);
}

TEST(Landing, TheTorqueMirrorsWithTheDirection) {
  for (const double velocity_rad_s : {0.0, 0.004, 0.3})
    for (const double distance_rad : {1e-6, 3e-5, 1e-3})
      EXPECT_EQ(landing_torque_Nm(model(), {0.3, 1.5}, velocity_rad_s, distance_rad, 0.001),
                -landing_torque_Nm(model(), {0.3, -1.5}, -velocity_rad_s, -distance_rad, 0.001));
}

TEST(Landing, RestsWhenTheJointStandsOnTheTargetAndNothingIsInDoubt) {
  Landing landing({0.001, kCount_rad, 1});
  landing.begin(0.5);
  JointEstimate there;
  there.position_rad = 0.5;
  there.disturbance.load_Nm = 3.0;
  int periods = 0;
  while (!landing.resting() && periods < 10) {
    EXPECT_EQ(landing.step(there, there, 0.5, model()), 3.0);
    ++periods;
  }
  EXPECT_EQ(periods, 2) << "the delay, and one more";
}

TEST(Landing, LooksForAnEdgeWhileFrictionIsInDoubtAndNoMoreThanEightTimes) {
  Landing landing({0.001, kCount_rad, 0});
  landing.begin(0.5);
  JointEstimate doubtful;
  doubtful.position_rad = 0.5;
  doubtful.friction_deviation_Nm = 0.3;
  int pushes = 0;
  for (int k = 0; k < 500 && !landing.resting(); ++k)
    if (landing.step(doubtful, doubtful, 0.5, model()) != 0.0) ++pushes;
  EXPECT_TRUE(landing.resting());
  EXPECT_GE(pushes, 1);
  EXPECT_LE(pushes, 8);
}

TEST(Landing, APushThatIsOverBeforeTheEncoderTellsOfItIsPlannedToItsEndAndNotAnswered) {
  for (const double told_rad_s : {0.0, 0.3, -0.3}) {
    Landing landing({0.001, kCount_rad, 2});
    landing.begin(0.5);
    JointEstimate before;
    before.position_rad = 0.5 - 2.0 * kCount_rad;
    for (int k = 0; k < 2; ++k) EXPECT_EQ(landing.step(before, before, 0.0, model()), 0.0);
    double position_rad = before.position_rad;
    double velocity_rad_s = 0.0;
    JointEstimate told = before;
    for (int k = 0; k < 20; ++k) {
      const ModelMotion motion =
          model().advance(landing.step(told, told, 0.0, model()), {}, velocity_rad_s, 0.001);
      position_rad += motion.displacement_rad;
      velocity_rad_s = motion.velocity_rad_s;
      told.velocity_rad_s = told_rad_s;
      if (motion.moved && velocity_rad_s == 0.0) break;
    }
    EXPECT_NEAR(position_rad, 0.5, 0.5 * kCount_rad) << told_rad_s;
  }
}

}  // namespace
}  // namespace strainwave
