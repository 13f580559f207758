// SPDX-License-Identifier: BSD-3-Clause
#include "commission/excitation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/input_error.h"
#include "commission/motion_spans.h"
#include "tests/commission/random_joints.h"

namespace strainwave::testing {
namespace {

TEST(Excitation, StaysInsideItsLimitsAndComesBack) {
  for (const std::uint64_t seed : {2U, 4U, 79U, 190U}) {
    const RandomJoint joint = random_joint(seed);
    const CommissionedJoint run = excite(joint);
    EXPECT_EQ(run.problem, "") << seed;
    const ExcitationLimits& limits = joint.excitation.limits;
    for (const JointSample& sample : run.trace.samples) {
      ASSERT_GE(sample.motor_position_rad, limits.position_min_rad) << seed;
      ASSERT_LE(sample.motor_position_rad, limits.position_max_rad) << seed;
      ASSERT_LE(std::abs(sample.torque_ordered_Nm), limits.torque_Nm) << seed;
    }
    EXPECT_LE(run.most_speed_rad_s, limits.speed_rad_s) << seed;
    EXPECT_LT(run.duration_s, 180.0) << seed;
    EXPECT_NEAR(run.trace.samples.back().motor_position_rad, joint.excitation.start_rad, 0.02) << seed;
  }
}

/// The reading of an enabled drive at this position.
ActuatorReading reading_at(double position_rad) {
  ActuatorReading reading;
  reading.joint_position_rad = position_rad;
  reading.has_position = true;
  reading.drive_state = DriveState::kEnabled;
  return reading;
}

TEST(Excitation, EndsWhereTorqueMovesTheJointTheOtherWay) {
  const RandomJoint joint = random_joint(2);
  SimulatedActuator drive(joint.drive);
  Excitation excitation(joint.excitation);
  for (std::int64_t k = 0; k < 20'000 && !excitation.ended(); ++k) {
    ActuatorReading reading = drive.read(k * 1'000'000);
    ActuatorCommand command = excitation.step(reading);
    command.torque_Nm *= -1.0;
    drive.write(command);
  }
  EXPECT_TRUE(excitation.ended());
  EXPECT_NE(excitation.problem().find("the other way"), std::string::npos) << excitation.problem();
}

TEST(Excitation, EndsWithTheNumbersWhereTheJointIsOutsideItsLimits) {
  const RandomJoint joint = random_joint(2);
  Excitation excitation(joint.excitation);
  excitation.step(reading_at(joint.excitation.limits.position_max_rad + 0.01));
  EXPECT_NE(excitation.problem().find("outside"), std::string::npos) << excitation.problem();
}

TEST(Excitation, EndsAtOnceWithAFaultOfTheDrive) {
  const RandomJoint joint = random_joint(2);
  Excitation excitation(joint.excitation);
  ActuatorReading reading = reading_at(joint.excitation.start_rad);
  excitation.step(reading);
  reading.fault = ActuatorFault::kPowerLost;
  EXPECT_FALSE(excitation.step(reading).enable);
  EXPECT_TRUE(excitation.ended());
}

TEST(Excitation, BrakesBeforeItEndsWhenItIsAborted) {
  const RandomJoint joint = random_joint(2);
  SimulatedActuator drive(joint.drive);
  Excitation excitation(joint.excitation);
  std::int64_t k = 0;
  for (; k < 8'000; ++k) drive.write(excitation.step(drive.read(k * 1'000'000)));
  excitation.abort("a key was pressed");
  for (const std::int64_t end = k + 3'000; k < end && !excitation.ended(); ++k)
    drive.write(excitation.step(drive.read(k * 1'000'000)));
  EXPECT_TRUE(excitation.ended());
  EXPECT_EQ(excitation.problem(), "a key was pressed");
  EXPECT_LT(std::abs(drive.plant().state().velocity_rad_s), 0.2 * joint.excitation.limits.speed_rad_s);
}

// The drive holds the joint before its brake opens. An abort before that leaves the brake shut.
TEST(Excitation, LeavesABrakeShutThatIsNotYetOpen) {
  const RandomJoint joint = random_joint(2);
  Excitation excitation(joint.excitation);
  ActuatorReading reading = reading_at(joint.excitation.start_rad);
  reading.brake_shut = true;
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(excitation.step(reading).enable);
  excitation.abort("a key was pressed");
  EXPECT_FALSE(excitation.step(reading).enable);
  EXPECT_TRUE(excitation.ended());
}

TEST(Excitation, DisablesAtOnceWhereThePositionJumps) {
  const RandomJoint joint = random_joint(2);
  Excitation excitation(joint.excitation);
  excitation.step(reading_at(joint.excitation.start_rad));
  EXPECT_FALSE(excitation.step(reading_at(joint.excitation.start_rad + 0.1)).enable)
      << "braking needs a position";
  EXPECT_NE(excitation.problem().find("jumped"), std::string::npos) << excitation.problem();
}

TEST(Excitation, EndsWhereTheJointMovesWithoutTorque) {
  const RandomJoint joint = random_joint(2);
  Excitation excitation(joint.excitation);
  double position_rad = joint.excitation.start_rad;
  for (int k = 0; k < 200 && excitation.problem().empty(); ++k)
    excitation.step(reading_at(position_rad -= 0.3e-3 * joint.excitation.limits.speed_rad_s));
  EXPECT_NE(excitation.problem().find("without torque"), std::string::npos) << excitation.problem();
}

// A hand blocks the joint, or the encoder is stuck.
TEST(Excitation, EndsAStrokeInWhichTheJointDoesNotMove) {
  ExcitationConfig config = random_joint(2).excitation;
  config.part = ExcitationPart::kSteadyStrokes;
  Excitation excitation(config);
  int periods = 0;
  for (; periods < 60'000 && excitation.problem().empty(); ++periods)
    excitation.step(reading_at(config.start_rad));
  EXPECT_NE(excitation.problem().find("does not move"), std::string::npos) << excitation.problem();
  EXPECT_LT(periods * config.period_s, 4.0);
}

TEST(Excitation, IsAbortedWhileItBrakesAtItsRegularEnd) {
  const RandomJoint joint = random_joint(2);
  ExcitationConfig config = joint.excitation;
  config.part = ExcitationPart::kRamps;
  SimulatedActuator drive(joint.drive);
  Excitation excitation(config);
  for (std::int64_t k = 0; k < 30'000 && !excitation.ended(); ++k) {
    drive.write(excitation.step(drive.read(k * 1'000'000)));
    if (excitation.stage() == Excitation::Stage::kBraking) excitation.abort("a key was pressed");
  }
  EXPECT_EQ(excitation.problem(), "a key was pressed");
}

// Feedback with the wrong sign would accelerate the joint instead of braking it.
TEST(Excitation, DisablesAJointThatSpeedsUpWhileItIsBraked) {
  const RandomJoint joint = random_joint(2);
  SimulatedActuator drive(joint.drive);
  Excitation excitation(joint.excitation);
  std::int64_t k = 0;
  for (; k < 60'000 && excitation.stage() != Excitation::Stage::kStroking; ++k)
    drive.write(excitation.step(drive.read(k * 1'000'000)));
  for (const std::int64_t end = k + 1'000; k < end; ++k)
    drive.write(excitation.step(drive.read(k * 1'000'000)));
  const double from_rad_s = std::abs(drive.plant().state().velocity_rad_s);
  excitation.abort("a key was pressed");
  double most_rad_s = 0.0;
  for (const std::int64_t end = k + 3'000; k < end && !excitation.ended(); ++k) {
    ActuatorCommand command = excitation.step(drive.read(k * 1'000'000));
    command.torque_Nm *= -20.0;  // more than friction
    drive.write(command);
    most_rad_s = std::max(most_rad_s, std::abs(drive.plant().state().velocity_rad_s));
  }
  EXPECT_TRUE(excitation.ended());
  EXPECT_LT(most_rad_s, from_rad_s + 0.5 * joint.excitation.limits.speed_rad_s);
}

TEST(Excitation, OfASlowJointWithAWideRangeEndsInThreeMinutesOrIsRefused) {
  ExcitationConfig config = random_joint(2).excitation;
  config.limits.position_min_rad = config.start_rad - 3.0;
  config.limits.position_max_rad = config.start_rad + 3.0;
  config.limits.speed_rad_s = 6.1 * sliding_speed_rad_s(config.gear_ratio);
  double from_rad = config.start_rad;
  double way_s = 0.0;
  for (const Stroke& stroke : plan_strokes(config)) {
    way_s += std::abs(stroke.to_rad - from_rad) / stroke.speed_rad_s;
    from_rad = stroke.to_rad;
  }
  EXPECT_LT(way_s, 0.9 * config.longest_s) << "turning round takes time as well";
  config.limits.speed_rad_s = 5.9 * sliding_speed_rad_s(config.gear_ratio);
  EXPECT_THROW(plan_strokes(config), InputError);
}

TEST(Excitation, RefusesLimitsThatAreTooNarrowForTwoMotorTurns) {
  ExcitationConfig config = random_joint(2).excitation;
  config.limits.position_min_rad = config.start_rad - 0.01;
  config.limits.position_max_rad = config.start_rad + 0.01;
  EXPECT_THROW(plan_strokes(config), InputError);
}

}  // namespace
}  // namespace strainwave::testing
