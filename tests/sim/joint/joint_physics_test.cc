// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/joint_physics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

// Coulomb friction only, so that every motion is a parabola.
constexpr double kCoulomb_Nm = 2.0;

JointInput constant_friction(double torque_Nm) {
  JointInput input;
  input.torque_Nm = torque_Nm;
  input.friction = {kCoulomb_Nm, kCoulomb_Nm, 0.0};
  return input;
}

JointInput reference_input(double torque_Nm, double temperature_C) {
  JointInput input;
  input.torque_Nm = torque_Nm;
  input.friction = reference_joint().friction.at(temperature_C);
  return input;
}

JointState moving(double velocity_rad_s) {
  return {0.0, velocity_rad_s, false};
}

TEST(JointPhysics, MirrorsExactlyWhenEverythingChangesSign) {
  const JointParameters joint = reference_joint();
  for (const double torque_Nm : {0.0, 1.0, 5.0, -20.0}) {
    for (const double velocity_rad_s : {0.0, 0.01, 0.05, 2.0}) {
      JointState state{0.0, velocity_rad_s, false};
      JointState mirrored{0.0, -velocity_rad_s, false};
      for (int k = 0; k < 50; ++k) {
        advance(state, joint, reference_input(torque_Nm, -10.0), 1e-3, 10);
        advance(mirrored, joint, reference_input(-torque_Nm, -10.0), 1e-3, 10);
      }
      EXPECT_EQ(state.position_rad, -mirrored.position_rad);
      EXPECT_EQ(state.velocity_rad_s, -mirrored.velocity_rad_s);
      EXPECT_EQ(state.stuck, mirrored.stuck);
    }
  }
}

TEST(JointPhysics, NeverGainsEnergyWithoutInput) {
  const JointParameters joint = reference_joint();
  for (const double temperature_C : {-10.0, 15.0, 45.0}) {
    for (const double velocity_rad_s : {1e-6, 0.01, -0.3, 8.0}) {
      JointState state = moving(velocity_rad_s);
      double energy_J = kinetic_energy(joint, state);
      for (int k = 0; k < 3000 && !state.stuck; ++k) {
        advance(state, joint, reference_input(0.0, temperature_C), 1e-3, 10);
        EXPECT_LT(kinetic_energy(joint, state), energy_J);
        energy_J = kinetic_energy(joint, state);
      }
      EXPECT_TRUE(state.stuck) << "friction alone stops every motion";
      EXPECT_EQ(state.velocity_rad_s, 0.0);
    }
  }
}

TEST(JointPhysics, StaysStuckExactlyWhileTheTorqueDoesNotExceedStaticFriction) {
  const JointParameters joint = reference_joint();
  const double static_Nm = joint.friction.at(10.0).static_Nm;
  for (const double direction : {-1.0, 1.0}) {
    JointState state;
    advance(state, joint, reference_input(direction * static_Nm, 10.0), 1.0, 1000);
    EXPECT_TRUE(state.stuck);
    EXPECT_EQ(state.position_rad, 0.0);

    const double above_Nm = std::nextafter(static_Nm, std::numeric_limits<double>::infinity());
    advance(state, joint, reference_input(direction * above_Nm, 10.0), 1e-3, 10);
    EXPECT_FALSE(state.stuck);
    EXPECT_GT(direction * state.velocity_rad_s, 0.0) << "breaks away in the direction of the torque";
    EXPECT_GT(direction * state.position_rad, 0.0);
  }
}

TEST(JointPhysics, ComparesTheTorqueLessTheLoadWithStaticFriction) {
  const JointParameters joint = reference_joint();
  JointInput input = reference_input(10.0, 20.0);
  input.load_torque_Nm = 10.0 - 0.5 * input.friction.static_Nm;
  JointState state;
  advance(state, joint, input, 0.1, 100);
  EXPECT_TRUE(state.stuck);
  input.load_torque_Nm = 10.0 + 2.0 * input.friction.static_Nm;
  advance(state, joint, input, 0.1, 100);
  EXPECT_LT(state.velocity_rad_s, 0.0) << "the load drives the joint back";
}

TEST(JointPhysics, StopsUnderConstantFrictionWhenAndWhereTheParabolaSays) {
  const JointParameters joint = reference_joint();
  const double velocity_rad_s = 1.7;
  const double stop_s = joint.inertia_kgm2 * velocity_rad_s / kCoulomb_Nm;
  const double stop_rad = 0.5 * velocity_rad_s * stop_s;

  JointState before = moving(velocity_rad_s);
  advance(before, joint, constant_friction(0.0), stop_s - 1e-9, 7);
  EXPECT_FALSE(before.stuck);
  JointState after = moving(velocity_rad_s);
  advance(after, joint, constant_friction(0.0), stop_s + 1e-9, 7);
  EXPECT_TRUE(after.stuck);
  JointState long_after = moving(velocity_rad_s);
  advance(long_after, joint, constant_friction(0.0), 10.0 * stop_s, 1);
  EXPECT_NEAR(long_after.position_rad, stop_rad, 1e-15) << "one long step finds the same event";
  EXPECT_NEAR(after.position_rad, stop_rad, 1e-15);
}

TEST(JointPhysics, PassesThroughRestWhenTheTorqueReversesTheMotion) {
  const JointParameters joint = reference_joint();
  const double velocity_rad_s = 0.8;
  const double torque_Nm = -9.0;
  const double stop_s = joint.inertia_kgm2 * velocity_rad_s / (-torque_Nm + kCoulomb_Nm);
  const double after_s = 0.013;
  const double back_rad_s2 = (torque_Nm + kCoulomb_Nm) / joint.inertia_kgm2;
  for (const int substeps : {1, 3, 10}) {
    JointState state = moving(velocity_rad_s);
    advance(state, joint, constant_friction(torque_Nm), stop_s + after_s, substeps);
    EXPECT_NEAR(state.velocity_rad_s, back_rad_s2 * after_s, 1e-13);
    EXPECT_NEAR(state.position_rad, 0.5 * velocity_rad_s * stop_s + 0.5 * back_rad_s2 * after_s * after_s,
                1e-14);
  }
}

TEST(JointPhysics, StaysAtRestAfterAStopWhenTheTorqueIsWithinStaticFriction) {
  const JointParameters joint = reference_joint();
  JointState state = moving(0.8);
  advance(state, joint, constant_friction(-0.999 * kCoulomb_Nm), 1.0, 10);
  EXPECT_TRUE(state.stuck);
  EXPECT_EQ(state.velocity_rad_s, 0.0);
  const double stop_s = joint.inertia_kgm2 * 0.8 / (1.999 * kCoulomb_Nm);
  EXPECT_NEAR(state.position_rad, 0.4 * stop_s, 1e-15);
}

TEST(JointPhysics, FollowsTheViscousExponential) {
  const JointParameters joint = reference_joint();
  JointInput input;
  input.friction = {0.0, 0.0, 2.5};
  const double rate = input.friction.viscous_Nms_rad / joint.inertia_kgm2;
  JointState state = moving(3.0);
  advance(state, joint, input, 0.1, 1000);
  EXPECT_NEAR(state.velocity_rad_s, 3.0 * std::exp(-rate * 0.1), 1e-9);
  EXPECT_NEAR(state.position_rad, 3.0 / rate * -std::expm1(-rate * 0.1), 1e-9);
}

TEST(JointPhysics, StopsUnderCoulombAndViscousFrictionWhereTheLogarithmSays) {
  const JointParameters joint = reference_joint();
  JointInput input = constant_friction(0.0);
  input.friction.viscous_Nms_rad = 2.5;
  const double w0 = 0.9;
  const double relaxation_s = joint.inertia_kgm2 / 2.5;
  const double logarithm = std::log1p(2.5 * w0 / kCoulomb_Nm);
  JointState state = moving(w0);
  advance(state, joint, input, 0.1, 1000);
  EXPECT_TRUE(state.stuck);
  EXPECT_NEAR(state.position_rad, relaxation_s * (w0 - kCoulomb_Nm / 2.5 * logarithm), 1e-13);
  JointState before = moving(w0);
  advance(before, joint, input, relaxation_s * logarithm - 1e-10, 300);
  EXPECT_FALSE(before.stuck);
}

// The velocity after 20 ms of motion inside the Stribeck range, and the position after a stop in it.
double final_velocity(int substeps) {
  JointState state = moving(0.01);
  advance(state, reference_joint(), reference_input(5.0, -10.0), 0.02, substeps);
  return state.velocity_rad_s;
}

double stopping_distance(int substeps) {
  JointState state = moving(0.15);
  advance(state, reference_joint(), reference_input(0.0, -10.0), 0.02, substeps);
  return state.stuck ? state.position_rad : std::numeric_limits<double>::quiet_NaN();
}

template <typename Quantity>
double observed_order(const Quantity& quantity, int coarse) {
  const double exact = quantity(64 * coarse);
  return std::log2(std::abs(quantity(coarse) - exact) / std::abs(quantity(2 * coarse) - exact));
}

TEST(JointPhysics, ConvergesWithTheFourthOrderBetweenEvents) {
  EXPECT_GT(observed_order(final_velocity, 20), 3.5);
}

TEST(JointPhysics, KeepsAtLeastTheThirdOrderThroughAStop) {
  // The stop lies anywhere within a step, so the error is not smooth in the step size. A large ratio of step sizes averages this out.
  const double exact = stopping_distance(20000);
  const double coarse = std::abs(stopping_distance(20) - exact);
  const double fine = std::abs(stopping_distance(320) - exact);
  EXPECT_GT(std::log2(coarse / fine) / 4.0, 3.0) << coarse << " " << fine;
}

TEST(JointPhysics, ReachesTheSpeedAtWhichBackEmfLeavesNoVoltage) {
  const JointParameters joint = reference_joint();
  JointInput input;
  input.torque_Nm = 1000.0;
  input.motor = MotorLimits::from_motor(reference_motor());
  JointState state;
  advance(state, joint, input, 1.0, 10000);
  EXPECT_NEAR(state.velocity_rad_s, 75.0 * kRadPerSecondPerRpm, 1e-9) << "75 V at 1 V/rpm";
}

TEST(JointPhysics, ApproachesTheNoLoadSpeedExponentiallyBelowThePeakTorque) {
  const JointParameters joint = reference_joint();
  JointInput input;
  input.torque_Nm = 1000.0;
  input.motor = MotorLimits::from_motor(reference_motor());
  input.motor.peak_torque_Nm = std::numeric_limits<double>::infinity();
  const double rate = input.motor.torque_per_speed_Nms_rad / joint.inertia_kgm2;
  JointState state;
  advance(state, joint, input, 4e-3, 400);
  EXPECT_NEAR(state.velocity_rad_s, -75.0 * kRadPerSecondPerRpm * std::expm1(-rate * 4e-3), 1e-9);
}

}  // namespace
}  // namespace strainwave
