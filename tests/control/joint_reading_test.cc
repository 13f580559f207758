// SPDX-License-Identifier: BSD-3-Clause
// A reading beside its plan.
#include "control/joint/joint_measurement.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kCount_rad = 1e-4;

JointMeasurement at(double position_rad) {
  JointMeasurement measurement;
  measurement.joint_position_rad = position_rad;
  return measurement;
}

TEST(JointReading, TakesTheVelocityOfAJumpOverAllPeriodsThatPassed) {
  JointReading reading(kPeriod_s, 1.0, kCount_rad);
  reading.reset(0.0, 0.0);
  reading.has_been_read();
  JointMeasurement late = at(0.01);
  late.elapsed_periods = 5;
  reading.step(late, 0.0, 0.0);
  EXPECT_NEAR(reading.velocity_rad_s(), 2.0, 1e-12);
}

TEST(JointReading, GoesOnAsFarBesideThePlanAsBeforeWhileThereIsNoReading) {
  JointReading reading(kPeriod_s, 1.0, kCount_rad);
  reading.reset(0.0, 0.0);
  reading.step(at(0.02), 0.01, 0.01);
  JointMeasurement blind = at(9.0);
  blind.has_position = false;
  reading.step(blind, 0.03, 0.03);
  EXPECT_NEAR(reading.position_rad(), 0.04, 1e-12);
}

TEST(JointReading, ComparesALateReadingWithThePlanOfItsOwnTime) {
  JointReading reading(kPeriod_s, 1.0, kCount_rad);
  reading.reset(0.0, 0.0);
  reading.step(at(0.01), 0.05, 0.01);
  EXPECT_NEAR(reading.position_rad(), 0.05, 1e-12);
}

TEST(JointReading, HasNoVelocityErrorWhereThePlanIsMetForAnyShare) {
  JointReading reading(kPeriod_s, 0.4, kCount_rad);
  reading.reset(0.0, 0.0);
  for (int k = 0; k < 20; ++k) {
    reading.step(at(1e-5 * k * k), 1e-5 * k * k, 1e-5 * k * k);
    EXPECT_NEAR(reading.velocity_rad_s(), reading.planned_velocity_rad_s(), 1e-9);
  }
}

TEST(JointReading, CountsThePeriodsInWhichItDoesNotChange) {
  JointReading reading(kPeriod_s, 1.0, kCount_rad);
  reading.reset(0.0, 0.0);
  for (int k = 0; k < 3; ++k) reading.step(at(0.0), 0.0, 0.0);
  EXPECT_EQ(reading.still_periods(), 3);
  reading.step(at(kCount_rad), 0.0, 0.0);
  EXPECT_EQ(reading.still_periods(), 0);
}

}  // namespace
}  // namespace strainwave
