// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/joint_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/joint/linear_joint.h"

namespace strainwave {
namespace {

TEST(FlexiblePhysics, CreepsBeforeItSlidesWithPresliding) {
  FlexibleJoint joint = linear_joint();
  joint.effects.friction.presliding_rad = 1e-4;
  FlexibleState state;
  const double static_Nm = cold(0.0).friction.static_Nm;
  run(state, joint, cold(0.5 * static_Nm), 1.0);
  EXPECT_GT(state.motor.position_rad, 0.3e-4);
  EXPECT_LT(state.motor.position_rad, 1.5e-4) << "held by the bristles";
  run(state, joint, cold(1.5 * static_Nm), 0.2);
  EXPECT_GT(state.motor.position_rad, 1e-2) << "slides";
}

TEST(FlexiblePhysics, ReachesTheCommandThroughTheCurrentLoopExponentially) {
  FlexibleJoint joint = linear_joint();
  joint.effects.drive.current_loop_s = 5e-4;
  FlexibleState state;
  for (int k = 1; k <= 5; ++k) {
    advance(state, joint, free_of_friction(10.0), 1e-3, 10);
    EXPECT_NEAR(state.current_Nm, -10.0 * std::expm1(-2.0 * k), 1e-12);
  }
}

TEST(FlexiblePhysics, AddsAShareOfTheTransmittedTorqueToFriction) {
  FlexibleJoint joint = linear_joint();
  const double static_Nm = cold(0.0).friction.static_Nm;
  const double transmitted_Nm = 20.0;
  for (const double share : {0.0, 0.1}) {
    joint.effects.friction.transmitted_share = share;
    FlexibleState state;  // the load winds the spring up; the motor must carry what friction does not
    state.link.position_rad = -transmitted_Nm / kStiffness_Nm_rad;
    JointInput input = cold(transmitted_Nm + static_Nm + 1.0);
    input.load_torque_Nm = transmitted_Nm;
    advance(state, joint, input, 1e-4, 1);
    EXPECT_EQ(state.motor.stuck, share > 0.0);
  }
}

TEST(FlexiblePhysics, HoldsTheMotorByMoreInOneDirectionThanInTheOther) {
  FlexibleJoint joint = linear_joint();
  joint.effects.friction.direction_share = 0.3;
  const double static_Nm = cold(0.0).friction.static_Nm;
  for (const double direction : {1.0, -1.0})
    for (const double share : {0.99, 1.01}) {
      FlexibleState state;
      advance(state, joint, cold(direction * share * (1.0 + 0.3 * direction) * static_Nm), 1e-3, 10);
      EXPECT_EQ(state.motor.stuck, share < 1.0) << direction;
      EXPECT_EQ(state.motor.position_rad == 0.0, share < 1.0) << direction;
    }
  // The same push moves the motor farther against the smaller friction, with and without presliding.
  for (const double presliding_rad : {0.0, 1e-4}) {
    joint.effects.friction.presliding_rad = presliding_rad;
    const auto way_rad = [&](double direction) {
      FlexibleState state;
      run(state, joint, cold(direction * 1.5 * static_Nm), 0.1);
      return direction * state.motor.position_rad;
    };
    EXPECT_GT(way_rad(-1.0), 2.0 * way_rad(1.0)) << presliding_rad;
  }
}

TEST(FlexiblePhysics, HitsAStopThatPushesAndNeverPulls) {
  FlexibleJoint joint = linear_joint();
  joint.effects.contact = {0.05, 2e4, 50.0};
  FlexibleState state;
  double deepest_rad = 0.0;
  for (int k = 0; k < 1000; ++k) {
    advance(state, joint, cold(12.0), 1e-3, 20);
    deepest_rad = std::max(deepest_rad, state.link.position_rad);
  }
  EXPECT_GT(deepest_rad, 0.05);
  EXPECT_LT(deepest_rad, 0.06);
  EXPECT_EQ(joint.effects.contact.torque_Nm(0.049, -100.0), 0.0);
  EXPECT_EQ(joint.effects.contact.torque_Nm(0.0501, -100.0), 0.0) << "a damper would hold the link back";
}

TEST(LostMotion, IsTheWidthOfTheLoopAtZeroTorque) {
  FlexibleJoint joint = linear_joint();
  Transmission& gear = *joint.effects.transmission;
  gear.spring = TorsionSpring::linear(8100.0);
  gear.lost_motion.width_rad = 5.8e-4;
  // The motor turns slowly against a link that its own friction holds.
  gear.link_coulomb_Nm = 1e6;
  const auto wind_up_at_zero_torque = [&](double direction) {
    FlexibleState state;
    state.motor.velocity_rad_s = 0.0;
    double last_Nm = 0.0;
    for (double angle_rad = -4e-3; angle_rad <= 4e-3; angle_rad += 1e-6) {
      // A step of the sliding element's equation, as the physics takes it.
      state.lost_motion_rad +=
          direction * 1e-6 - 1e-6 * state.lost_motion_rad / (0.5 * gear.lost_motion.width_rad);
      state.motor.position_rad = direction * angle_rad;
      const double torque_Nm = transmitted_torque_Nm(joint, state);
      if (angle_rad > -3.9e-3 && torque_Nm * last_Nm < 0.0) return direction * angle_rad;
      last_Nm = torque_Nm;
    }
    return 0.0;
  };
  EXPECT_NEAR(std::abs(wind_up_at_zero_torque(1.0) - wind_up_at_zero_torque(-1.0)), 5.8e-4, 6e-6);
}

}  // namespace
}  // namespace strainwave
