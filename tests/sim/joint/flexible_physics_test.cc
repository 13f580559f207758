// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/flexible_physics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/joint/linear_joint.h"

namespace strainwave {
namespace {

TEST(FlexiblePhysics, StaysBoundedAtSpeedHoweverShortPreslidingAndLostMotionAre) {
  for (const double short_rad : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    FlexibleJoint joint = linear_joint();
    joint.effects.transmission->lost_motion.width_rad = short_rad;
    joint.effects.friction.presliding_rad = short_rad;
    FlexibleState state;
    run(state, joint, cold(34.0), 0.1);
    run(state, joint, cold(-34.0), 0.1);
    EXPECT_LT(std::abs(state.motor.velocity_rad_s), 34.0 * 0.2 / (kMotor_kgm2 + kLink_kgm2)) << short_rad;
    EXPECT_LE(std::abs(state.lost_motion_rad), 0.5001 * short_rad) << short_rad;
  }
}

TEST(FlexiblePhysics, ConservesEnergyWithoutLosses) {
  FlexibleJoint joint = linear_joint();
  joint.effects.transmission->kinematic_error = {{4e-4, 2e-4}, {0.3, 1.1}};
  joint.effects.gravity = {5.0, 0.2};
  FlexibleState state;
  state.motor.velocity_rad_s = 0.5;
  state.link.velocity_rad_s = -0.3;
  const double energy_J = mechanical_energy_J(joint, state);
  for (int k = 0; k < 200; ++k) {
    advance(state, joint, free_of_friction(0.0), 1e-3, 100);
    ASSERT_NEAR(mechanical_energy_J(joint, state), energy_J, 1e-9 * energy_J);
  }
}

TEST(FlexiblePhysics, SwingsAtTheFreeFreeFrequency) {
  const FlexibleJoint joint = linear_joint();
  const double frequency_rad_s = free_free_frequency_rad_s(kMotor_kgm2, kLink_kgm2, kStiffness_Nm_rad);
  FlexibleState state;
  const double wind_up_rad = 1e-3;
  state.motor.position_rad = wind_up_rad;
  for (int k = 1; k <= 100; ++k) {
    advance(state, joint, free_of_friction(0.0), 1e-3, 100);
    ASSERT_NEAR(state.motor.position_rad - state.link.position_rad,
                wind_up_rad * std::cos(frequency_rad_s * 1e-3 * k), 1e-9 * wind_up_rad);
  }
}

TEST(FlexiblePhysics, FollowsTheAnalyticStepOfTheLinearCase) {
  const FlexibleJoint joint = linear_joint();
  const double torque_Nm = 7.0;
  const double total_kgm2 = kMotor_kgm2 + kLink_kgm2;
  const double frequency_rad_s = free_free_frequency_rad_s(kMotor_kgm2, kLink_kgm2, kStiffness_Nm_rad);
  FlexibleState state;
  for (int k = 1; k <= 100; ++k) {
    advance(state, joint, free_of_friction(torque_Nm), 1e-3, 100);
    const double time_s = 1e-3 * k;
    const double wind_up_rad =
        torque_Nm * kLink_kgm2 / total_kgm2 / kStiffness_Nm_rad * (1.0 - std::cos(frequency_rad_s * time_s));
    const double centre_rad = 0.5 * torque_Nm / total_kgm2 * time_s * time_s;
    ASSERT_NEAR(state.link.position_rad, centre_rad - kMotor_kgm2 / total_kgm2 * wind_up_rad,
                1e-9 * centre_rad);
    ASSERT_NEAR(state.motor.position_rad, centre_rad + kLink_kgm2 / total_kgm2 * wind_up_rad,
                1e-9 * centre_rad);
  }
}

TEST(FlexiblePhysics, ApproachesTheRigidJointWithALightLinkOnAStiffSpring) {
  double last_difference_rad = 1.0;
  for (const double link_kgm2 : {1e-3, 1e-4, 1e-5}) {
    FlexibleJoint joint = linear_joint();
    joint.effects.transmission->link_inertia_kgm2 = link_kgm2;
    joint.effects.transmission->damping_Nms_rad =
        structural_damping_Nms_rad(kMotor_kgm2, link_kgm2, kStiffness_Nm_rad, 0.1);
    FlexibleState state;
    JointState rigid;
    for (int k = 0; k < 60; ++k) {
      const JointInput input = cold(k < 30 ? 12.0 : -5.0);
      advance(state, joint, input, 1e-3, 100);
      advance(rigid, joint.motor, input, 1e-3, 100);
    }
    const double difference_rad = std::abs(state.motor.position_rad - rigid.position_rad);
    EXPECT_LT(difference_rad, 0.2 * last_difference_rad);
    last_difference_rad = difference_rad;
    EXPECT_EQ(state.motor.stuck, rigid.stuck);
  }
  EXPECT_LT(last_difference_rad, 1e-5);
}

TEST(FlexiblePhysics, IsTheRigidJointsMotionWithoutATransmission) {
  FlexibleJoint joint;
  joint.motor = reference_joint();
  FlexibleState state;
  JointState rigid;
  for (int k = 0; k < 200; ++k) {
    const JointInput input = cold(k < 60 ? 11.0 : k < 120 ? -14.0 : 1.0);
    advance(state, joint, input, 1e-3, 20);
    advance(rigid, joint.motor, input, 1e-3, 20);
    ASSERT_NEAR(state.motor.position_rad, rigid.position_rad, 1e-9);
    ASSERT_NEAR(state.motor.velocity_rad_s, rigid.velocity_rad_s, 1e-7);
    ASSERT_EQ(state.motor.stuck, rigid.stuck);
  }
}

TEST(FlexiblePhysics, KeepsTheMotorStuckExactlyWhileTorqueAndSpringAreWithinStaticFriction) {
  const FlexibleJoint joint = linear_joint();
  const double static_Nm = cold(0.0).friction.static_Nm;
  FlexibleState state;  // the link swings on the locked motor
  state.link.position_rad = 0.99 * static_Nm / kStiffness_Nm_rad;
  run(state, joint, cold(0.0), 0.5, 100);
  EXPECT_EQ(state.motor.position_rad, 0.0);
  EXPECT_EQ(state.motor.velocity_rad_s, 0.0);
  EXPECT_TRUE(state.motor.stuck);
  EXPECT_NEAR(
      state.link.position_rad,
      0.99 * static_Nm / kStiffness_Nm_rad * std::cos(std::sqrt(kStiffness_Nm_rad / kLink_kgm2) * 0.5),
      1e-10);

  FlexibleState beyond;
  beyond.link.position_rad = 1.01 * static_Nm / kStiffness_Nm_rad;
  run(beyond, joint, cold(0.0), 0.5);
  EXPECT_NE(beyond.motor.position_rad, 0.0);
  FlexibleState pushed;
  run(pushed, joint, cold(0.999 * static_Nm), 0.1);
  EXPECT_EQ(pushed.motor.position_rad, 0.0);
}

FlexibleJoint joint_with_everything() {
  FlexibleJoint joint = linear_joint();
  Transmission& gear = *joint.effects.transmission;
  gear.spring = find_gear("csf-17-50")->spring;
  gear.damping_Nms_rad = 2.0;
  gear.lost_motion.width_rad = 5.8e-4;
  gear.kinematic_error = {{3e-4, 1e-4}, {0.0, 0.5}};
  gear.link_coulomb_Nm = 0.3;
  gear.link_viscous_Nms_rad = 0.1;
  joint.effects.friction.transmitted_share = 0.06;
  joint.effects.drive = {5e-4, 0.02, 12.0};
  return joint;
}

TEST(FlexiblePhysics, NeverGainsEnergyWithoutInput) {
  for (const double presliding_rad : {0.0, 1e-4}) {
    FlexibleJoint joint = joint_with_everything();
    joint.effects.friction.presliding_rad = presliding_rad;
    FlexibleState state;
    state.motor.velocity_rad_s = 1.5;
    state.link.velocity_rad_s = -0.5;
    const double begin_J = mechanical_energy_J(joint, state);
    double energy_J = begin_J;
    // The bristles store a little energy that mechanical_energy_J() does not count: 1/2 Fs z.
    const double bristles_J = 0.5 * 10.0 * presliding_rad;
    for (int k = 0; k < 500; ++k) {
      advance(state, joint, cold(0.0), 1e-3, 20);
      const double now_J = mechanical_energy_J(joint, state);
      ASSERT_LE(now_J, energy_J + bristles_J + 1e-9 * begin_J) << "period " << k;
      energy_J = now_J;
    }
    EXPECT_LT(energy_J, 1e-2 * begin_J);
  }
}

TEST(FlexiblePhysics, MirrorsWhenEverythingChangesSign) {
  FlexibleJoint joint = joint_with_everything();
  joint.effects.transmission->kinematic_error.phase_rad = {0.0, 0.0};  // odd in the angle
  joint.effects.drive.ripple_share = 0.0;
  FlexibleState state;
  FlexibleState mirrored;
  for (int k = 0; k < 300; ++k) {
    const double torque_Nm = k < 50 ? 15.0 : k < 100 ? -12.0 : 3.0;
    advance(state, joint, cold(torque_Nm), 1e-3, 10);
    advance(mirrored, joint, cold(-torque_Nm), 1e-3, 10);
    ASSERT_NEAR(state.link.position_rad, -mirrored.link.position_rad, 1e-12);
    ASSERT_EQ(state.motor.stuck, mirrored.motor.stuck);
  }
}

TEST(FlexiblePhysics, ConvergesAsTheStepsShrinkThroughStickAndSlip) {
  const FlexibleJoint joint = joint_with_everything();
  const auto end = [&](int substeps) {
    FlexibleState state;
    run(state, joint, cold(9.0), 0.05, substeps);
    run(state, joint, cold(-4.0), 0.1, substeps);
    return state.link.position_rad;
  };
  const double exact = end(640);
  EXPECT_LT(std::abs(end(40) - exact), 1e-6);
  EXPECT_LT(std::abs(end(160) - exact), 0.3 * std::abs(end(10) - exact));
}

}  // namespace
}  // namespace strainwave
