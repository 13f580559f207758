// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/motor_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

/// data/rhs17_datasheet.csv at the joint: 34 N.m, 9.6 N.m/A, 1 V/rpm, 4.8 ohm, 75 V.
constexpr MotorData kMotor{34.0, 9.6, 1.0 / kRadPerSecondPerRpm, 4.8, 75.0};

TEST(MotorLimits, AllowThePeakWhenBrakingAndLessWhenDriving) {
  const MotorLimits motor = MotorLimits::from_motor(kMotor);
  const double fast_rad_s = 70.0 * kRadPerSecondPerRpm;
  EXPECT_NEAR(motor.limit_Nm(100.0, fast_rad_s), 9.6 * (75.0 - 70.0) / 4.8, 1e-12);
  EXPECT_NEAR(motor.limit_Nm(-100.0, -fast_rad_s), -9.6 * (75.0 - 70.0) / 4.8, 1e-12);
  EXPECT_EQ(motor.limit_Nm(-100.0, fast_rad_s), -34.0);
  EXPECT_EQ(motor.limit_Nm(100.0, -fast_rad_s), 34.0);
  EXPECT_EQ(motor.limit_Nm(100.0, 2.0 * fast_rad_s), 0.0)
      << "past the no-load speed nothing is left to drive with";
  EXPECT_EQ(motor.limit_Nm(3.0, 0.0), 3.0);
  EXPECT_EQ(motor.limit_Nm(100.0, 0.0), 34.0);
}

TEST(MotorLimits, AreNoneUnlessSomeAreGiven) {
  EXPECT_EQ(MotorLimits{}.limit_Nm(1e9, 1e3), 1e9);
  EXPECT_EQ(MotorLimits::from_motor({}).limit_Nm(-1e9, 1e3), -1e9);
}

TEST(MotorLimits, AreThePeakAloneWhereSupplyOrResistanceIsNotKnown) {
  for (const bool supply_known : {true, false}) {
    MotorData motor = kMotor;
    (supply_known ? motor.resistance_ohm : motor.supply_V) = 0.0;
    EXPECT_EQ(MotorLimits::from_motor(motor).limit_Nm(1e9, 1e6), 34.0);
  }
}

TEST(MotorLimits, NeverChangeATorquesSignNorItsSymmetry) {
  const MotorLimits motor = MotorLimits::from_motor(kMotor);
  for (double torque_Nm = -200.0; torque_Nm <= 200.0; torque_Nm += 7.3) {
    for (double velocity_rad_s = -30.0; velocity_rad_s <= 30.0; velocity_rad_s += 1.1) {
      const double limited_Nm = motor.limit_Nm(torque_Nm, velocity_rad_s);
      EXPECT_GE(limited_Nm * torque_Nm, 0.0);
      EXPECT_LE(std::abs(limited_Nm), std::min(34.0, std::abs(torque_Nm)));
      EXPECT_EQ(limited_Nm, -motor.limit_Nm(-torque_Nm, -velocity_rad_s));
    }
  }
}

MotionLimits limits(double load_Nm, double speed_rad_s) {
  return reachable_limits({10.0, 1e6, 1e6}, MotorLimits::from_motor(kMotor), testing::reference_model(),
                          load_Nm, {34.0, 34.0}, 0.02, speed_rad_s, 0.001);
}

TEST(ReachableLimits, TheirAccelerationIsOneThatTheMotorHasAgainstFriction) {
  for (const double speed_rad_s : {0.0, 1.0, 3.0, 6.0}) {
    const double acceleration_rad_s2 = limits(0.0, speed_rad_s).acceleration_rad_s2;
    const double needed_Nm = testing::reference_model().inertia_kgm2 * acceleration_rad_s2 + 3.6 +
                             2.3 * (speed_rad_s + 0.001 * acceleration_rad_s2);
    EXPECT_LE(needed_Nm,
              MotorLimits::from_motor(kMotor).available_Nm(speed_rad_s + 0.001 * acceleration_rad_s2) + 1e-9)
        << speed_rad_s;
  }
}

TEST(ReachableLimits, ALoadCountsAgainstAccelerationAndDeceleration) {
  const MotionLimits free = limits(0.0, 0.0);
  for (const double load_Nm : {-8.0, 8.0}) {
    EXPECT_LT(limits(load_Nm, 0.0).acceleration_rad_s2, free.acceleration_rad_s2);
    EXPECT_LT(limits(load_Nm, 0.0).deceleration_rad_s2, free.deceleration_rad_s2);
  }
}

TEST(ReachableLimits, FallWithTheDrivingTorqueAndTheDecelerationStays) {
  MotionLimits before = limits(2.0, 0.0);
  for (double driving_Nm = 34.0; driving_Nm >= 0.0; driving_Nm -= 0.5) {
    const MotionLimits now =
        reachable_limits({10.0, 1e6, 1e6}, MotorLimits::from_motor(kMotor), testing::reference_model(), 2.0,
                         {driving_Nm, 34.0}, 0.02, 0.0, 0.001);
    EXPECT_LE(now.acceleration_rad_s2, before.acceleration_rad_s2) << driving_Nm;
    EXPECT_LE(now.velocity_rad_s, before.velocity_rad_s) << driving_Nm;
    EXPECT_EQ(now.deceleration_rad_s2, before.deceleration_rad_s2) << driving_Nm;
    EXPECT_GT(now.acceleration_rad_s2, 0.0) << "it never stops for good";
    EXPECT_GT(now.velocity_rad_s, 0.0);
    before = now;
  }
  EXPECT_LT(before.acceleration_rad_s2, 0.05 * limits(2.0, 0.0).acceleration_rad_s2);
}

TEST(ReachableLimits, EndAtASpeedThatTheMotorHoldsAgainstFrictionAndTheirAccelerationWithIt) {
  const MotorLimits motor = MotorLimits::from_motor(kMotor);
  const auto at = [&](double load_Nm, double speed_rad_s) {
    return reachable_limits({1e3, 1e6, 1e6}, motor, testing::reference_model(), load_Nm, {34.0, 34.0}, 0.02,
                            speed_rad_s, 0.001);
  };
  for (const double load_Nm : {0.0, 8.0}) {
    const double top_rad_s = at(load_Nm, 0.0).velocity_rad_s;
    EXPECT_LE(3.6 + load_Nm + 2.3 * top_rad_s, motor.available_Nm(top_rad_s)) << load_Nm;
    EXPECT_GT(3.6 + load_Nm + 2.3 * 1.1 * top_rad_s, motor.available_Nm(1.1 * top_rad_s))
        << "no slower than reserve and trickle make it";
    EXPECT_EQ(at(load_Nm, 2.0 * top_rad_s).velocity_rad_s, top_rad_s);
  }
  const MotionLimits stuck = at(1000.0, 0.0);
  EXPECT_GT(std::min({stuck.velocity_rad_s, stuck.acceleration_rad_s2, stuck.deceleration_rad_s2}), 0.0)
      << "a trickle is left under a load that nothing can move";
}

}  // namespace
}  // namespace strainwave
