// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/disturbance_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

JointPlantConfig joint_with(double load_inertia_kgm2) {
  JointPlantConfig plant = flexible_plant();
  plant.effects.transmission->link_inertia_kgm2 = load_inertia_kgm2;
  return plant;
}

/// Position of the motor two seconds after a step of the setpoint to `target_rad`, against `load_Nm`.
double place_after_step(const JointPlantConfig& config, double target_rad, double load_Nm) {
  DisturbanceObserverPeer peer(servo_joint(config));
  JointPlant plant(config);
  peer.reset(0.0);
  for (int k = 0; k < 2000; ++k) {
    plant.set_ambient_temperature(20.0);
    plant.step(peer.step({target_rad, 0.0, 0.0}, plant.measured_position_rad()), load_Nm);
  }
  return plant.state().position_rad;
}

TEST(ServoPeer, IsToldOfTheWholeInertiaAndOfTheResonance) {
  const ServoJoint joint = servo_joint(flexible_plant());
  EXPECT_DOUBLE_EQ(joint.inertia_kgm2, 2.0 * kReferenceInertia_kgm2);
  EXPECT_NEAR(joint.resonance_rad_s, std::sqrt(2.0 * 8100.0 / kReferenceInertia_kgm2), 1e-9);
  EXPECT_DOUBLE_EQ(joint.small_times_s(), 0.002);
}

TEST(ServoPeer, IsAsFastAsDelayAndResonanceLetIt) {
  ServoJoint joint = servo_joint(realistic_plant());
  EXPECT_DOUBLE_EQ(velocity_bandwidth_rad_s(joint), 250.0) << "a rigid joint: the delay alone";
  joint.resonance_rad_s = 100.0;
  EXPECT_DOUBLE_EQ(velocity_bandwidth_rad_s(joint), 50.0);
  joint.motor_inertia_kgm2 = 0.05 * joint.inertia_kgm2;
  EXPECT_DOUBLE_EQ(velocity_bandwidth_rad_s(joint), 25.0) << "a motor of a twentieth of the inertia";
}

// Without its observer, a proportional-derivative controller would keep an error of load / gain, here 4.6 mrad, plus that of friction.
TEST(DisturbanceObserverPeer, LeavesNothingOfAConstantLoad) {
  JointPlantConfig plant = joint_with(0.1);
  plant.joint.friction.amplitude = plant.joint.friction.asymptote = {0.0, 0.0, 0.5};
  EXPECT_NEAR(place_after_step(plant, 0.01, 10.0), 0.01, 4e-5);
}

TEST(DisturbanceObserverPeer, ComesToItsTargetOnEveryLinkOfTheGrid) {
  for (const double load_inertia_kgm2 : {0.03, 0.1, 0.267})
    EXPECT_NEAR(place_after_step(joint_with(load_inertia_kgm2), 0.1, 0.0), 0.1, 1e-3) << load_inertia_kgm2;
}

TEST(DisturbanceObserverPeer, WantsNoMoreThanItsTorqueLimit) {
  const ServoJoint joint = servo_joint(flexible_plant());
  DisturbanceObserverPeer peer(joint);
  peer.reset(0.0);
  EXPECT_EQ(peer.step({1.0, 0.0, 0.0}, 0.0), joint.torque_limit_Nm);
  EXPECT_EQ(peer.step({-1.0, 0.0, 0.0}, 0.0), -joint.torque_limit_Nm);
}

}  // namespace
}  // namespace strainwave
