// SPDX-License-Identifier: BSD-3-Clause
// The planned torque on an independent model of the joint: two masses, a linear spring, no friction.
#include "control/trajectory/motor_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/joint/gear_catalogue.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kLimit_Nm = 34.0;
constexpr double kBand_rad = 20e-6;
constexpr double kTwoCounts_rad = 40e-6;

MotorPlannerConfig config_for(double link_kgm2, double stiffness_Nm_rad, int delay_periods = 0) {
  MotorPlannerConfig config;
  config.period_s = kPeriod_s;
  config.joint = {0.089, link_kgm2, TorsionSpring::linear(stiffness_Nm_rad), 0.0, {}};
  config.torque_limit_Nm = kLimit_Nm;
  config.delay_periods = delay_periods;
  return config;
}

ReferenceShaper shaper_for(const MotorPlannerConfig& config, double target_rad) {
  ReferenceShaper shaper(kPeriod_s);
  const double most = (0.95 * kLimit_Nm - config.joint.gravity.torque_Nm) /
                      (config.joint.motor_inertia_kgm2 + config.joint.link_inertia_kgm2);
  shaper.set_limits({100.0, most, most});
  shaper.reset(0.0, 0.0);
  shaper.set_target(target_rad);
  return shaper;
}

struct Outcome {
  double residual_rad = 0.0;  ///< largest error of the link in the first periods after the motion
  double wind_up_rad = 0.0;   ///< largest
  double peak_Nm = 0.0;
  double motor_error_rad = 0.0;  ///< largest distance of the motor from the plan during the motion
};

// One step of the plan with the whole torque range available.
MotorPlan step(MotorPlanner& motion, const Reference& planned) {
  return motion.step(planned, {-kLimit_Nm, kLimit_Nm}, 0.0);
}

Outcome run(const MotorPlannerConfig& config, const LinkModel& joint, double target_rad) {
  MotorPlanner motion(config);
  ReferenceShaper shaper = shaper_for(config, target_rad);
  double motor = 0.0, motor_speed = 0.0, link = 0.0, link_speed = 0.0;
  Outcome outcome;
  int rest_periods = 0;
  for (int k = 0; k < 2000; ++k) {
    const MotorPlan plan = step(motion, shaper.step());
    if (motion.moves())
      outcome.motor_error_rad = std::max(outcome.motor_error_rad, std::abs(motor - plan.position_rad));
    outcome.peak_Nm = std::max(outcome.peak_Nm, std::abs(plan.torque_Nm));
    constexpr int kSubsteps = 500;
    for (int i = 0; i < kSubsteps; ++i) {
      const double spring_Nm = joint.spring.torque_Nm(motor - link);
      motor_speed += kPeriod_s / kSubsteps / joint.motor_inertia_kgm2 * (plan.torque_Nm - spring_Nm);
      link_speed += kPeriod_s / kSubsteps / joint.link_inertia_kgm2 * spring_Nm;
      motor += kPeriod_s / kSubsteps * motor_speed;
      link += kPeriod_s / kSubsteps * link_speed;
    }
    outcome.wind_up_rad = std::max(outcome.wind_up_rad, std::abs(motor - link));
    // Only the first periods show the swing. Without friction the joint then drifts away with its remaining speed.
    if (!motion.moves() && ++rest_periods < 10)
      outcome.residual_rad = std::max(outcome.residual_rad, std::abs(link - target_rad));
  }
  EXPECT_GE(rest_periods, 100) << "the motion never ends";
  return outcome;
}

TEST(MotorPlanner, AJointAsItWasToldFollowsWithinACountAndDoesNotSwing) {
  for (const double link : {0.03, 0.089, 0.267})
    for (const double stiffness : {8100.0, 13000.0})
      for (const double target : {0.01, 0.1, -1.0}) {
        const MotorPlannerConfig config = config_for(link, stiffness);
        const Outcome outcome = run(config, config.joint, target);
        EXPECT_LE(outcome.residual_rad, kTwoCounts_rad) << link << " " << stiffness << " " << target;
        EXPECT_LE(outcome.motor_error_rad, kBand_rad) << link << " " << stiffness << " " << target;
        if (target != -1.0) continue;
        EXPECT_NEAR(outcome.peak_Nm / kLimit_Nm, 1.1, 0.2) << "hardly more torque than the rigid motion";
      }
}

TEST(MotorPlanner, SwingsLessThanTheSameTorqueWithoutIt) {
  // The plan for a nearly rigid joint is the shaper's acceleration alone. It leaves a swing as large as the wind-up.
  const MotorPlannerConfig config = config_for(0.089, 10000.0);
  MotorPlannerConfig stiff = config;
  stiff.joint.spring = TorsionSpring::linear(1e7);
  EXPECT_GE(run(stiff, config.joint, 0.1).residual_rad, 10.0 * run(config, config.joint, 0.1).residual_rad);
}

TEST(MotorPlanner, BearsAStiffnessAndALoadThatAreNotWhatItWasTold) {
  const MotorPlannerConfig config = config_for(0.089, 10000.0);
  for (const double share : {0.75, 1.25}) {
    const Outcome outcome = run(config, config_for(0.089, share * 10000.0).joint, 0.1);
    EXPECT_LE(outcome.residual_rad, 0.6 * outcome.wind_up_rad) << share;
  }
}

// The plan includes the damper's torque in the wind-up. Without it the link would lag behind its motion and overshoot.
// A configuration may contain damping up to 0.5 of critical damping.
TEST(MotorPlanner, ALinkOnADampedSpringKeepsToItsMotion) {
  for (const double link : {0.089, 0.267})
    for (const double ratio : {0.1, 0.5}) {
      MotorPlannerConfig config = config_for(link, 10000.0);
      config.joint.damping_Nms_rad = structural_damping_Nms_rad(0.089, link, 10000.0, ratio);
      MotorPlanner motion(config);
      ReferenceShaper shaper = shaper_for(config, 1e-3);
      double farthest_rad = 0.0;
      int periods = 0;
      do {
        farthest_rad = std::max(farthest_rad, step(motion, shaper.step()).link_position_rad);
      } while (motion.moves() && ++periods < 1000);
      EXPECT_LT(periods, 1000) << link;
      EXPECT_LE(farthest_rad - 1e-3, 12e-6) << link << " " << ratio;
    }
}

TEST(MotorPlanner, TellsWhereTheMotorIsReadNowAndTheTorqueThatActsLater) {
  MotorPlanner now(config_for(0.089, 10000.0, 0));
  MotorPlanner late(config_for(0.089, 10000.0, 2));
  ReferenceShaper shaper = shaper_for(config_for(0.089, 10000.0), 0.1);
  std::array<double, 3> positions_rad{};
  for (int k = 0; k < 200; ++k) {
    const Reference planned = shaper.step();
    const MotorPlan first = step(now, planned);
    const MotorPlan second = step(late, planned);
    EXPECT_EQ(first.torque_Nm, second.torque_Nm);
    std::copy_backward(positions_rad.begin(), positions_rad.end() - 1, positions_rad.end());
    positions_rad.front() = first.position_rad;
    EXPECT_EQ(second.position_rad, positions_rad.back());
  }
}

TEST(MotorPlanner, MovesAtOnceAndRestsExactlyOnTheTarget) {
  const MotorPlannerConfig config = config_for(0.089, 10000.0, 1);
  MotorPlanner motion(config);
  EXPECT_FALSE(motion.moves());
  ReferenceShaper shaper = shaper_for(config, 0.1);
  EXPECT_NE(step(motion, shaper.step()).torque_Nm, 0.0);
  EXPECT_TRUE(motion.moves());
  MotorPlan plan;
  for (int k = 0; k < 500; ++k) plan = step(motion, shaper.step());
  EXPECT_FALSE(motion.moves());
  EXPECT_EQ(plan.position_rad, 0.1);
  EXPECT_EQ(plan.velocity_rad_s, 0.0);
  EXPECT_EQ(plan.torque_Nm, 0.0);
}

TEST(MotorPlanner, FollowsASpringOfThreeSlopesAndAWeightAsWell) {
  MotorPlannerConfig config = config_for(0.1, 1.0);
  config.joint.spring = find_gear("csf-17-50")->spring;
  config.joint.gravity = {10.0, -0.5};
  MotorPlanner motion(config);
  const double standing_rad = motion.motor_rest_rad(0.0);
  EXPECT_NEAR(motion.reset(standing_rad), 0.0, 1e-9) << "the link is where the motor and the weight say";
  ReferenceShaper shaper = shaper_for(config, 0.1);
  LinkState joint{0.0, 0.0, standing_rad, 0.0};
  double farthest_rad = 0.0;
  for (int k = 0; k < 500; ++k) {
    const MotorPlan plan = step(motion, shaper.step());
    if (!motion.moves()) break;
    farthest_rad = std::max(farthest_rad, std::abs(joint.motor_position_rad - plan.position_rad));
    for (int i = 0; i < 20; ++i) joint = config.joint.advance(joint, plan.torque_Nm, kPeriod_s / 20).end;
  }
  EXPECT_FALSE(motion.moves());
  EXPECT_LE(farthest_rad, kBand_rad);
  EXPECT_NEAR(joint.link_position_rad, 0.1, kBand_rad);
  EXPECT_NEAR(joint.motor_position_rad, motion.motor_rest_rad(0.1), kBand_rad);
}

TEST(MotorPlanner, SwingsNothingUpWhereTheMotionAsksForMoreThanThereIs) {
  for (const double link : {0.03, 0.1, 0.267}) {
    MotorPlannerConfig config = config_for(link, 1.0);
    config.joint.spring = find_gear("csf-17-50")->spring;
    config.joint.gravity = {10.0, -0.5};
    MotorPlanner motion(config);
    ReferenceShaper shaper = shaper_for(config_for(link, 1.0), 0.1);  // ignores gravity
    int periods = 0;
    double farthest_rad = 0.0;
    do {
      farthest_rad = std::max(farthest_rad, step(motion, shaper.step()).link_position_rad);
    } while (motion.moves() && ++periods < 1000);
    EXPECT_LT(periods, 300) << link;
    EXPECT_LT(farthest_rad, 0.103) << link;
  }
}

TEST(MotorPlanner, AsksForNoMoreThanThereIs) {
  const MotorPlannerConfig config = config_for(0.089, 10000.0);
  MotorPlanner motion(config);
  ReferenceShaper shaper = shaper_for(config, 1e-3);  // so short that the motion alone would need more torque
  double taken_Nm = 5.0;
  for (int k = 0; k < 200; ++k) {
    const MotorPlan plan =
        motion.step(shaper.step(), {-kLimit_Nm - taken_Nm, kLimit_Nm - taken_Nm}, taken_Nm);
    EXPECT_LE(std::abs(plan.torque_Nm + taken_Nm), kLimit_Nm + 1e-9) << k;
    taken_Nm = -taken_Nm;
  }
}

TEST(MotorPlanner, GoesOnFromAJointThatMoves) {
  MotorPlanner motion(config_for(0.089, 10000.0, 1));
  double planned_rad = motion.reset(0.5, 2.0);
  double last_rad = 0.5 - 2.0 * kPeriod_s;
  for (int k = 0; k < 50; ++k) {
    const MotorPlan plan = step(motion, {planned_rad, 2.0, 0.0});
    planned_rad += 2.0 * kPeriod_s;
    EXPECT_NEAR(plan.position_rad, last_rad + 2.0 * kPeriod_s, 1e-12) << k;
    EXPECT_NEAR(plan.velocity_rad_s, 2.0, 1e-9) << k;
    EXPECT_NEAR(plan.torque_Nm, 0.0, 1e-6) << k;
    last_rad = plan.position_rad;
    EXPECT_TRUE(motion.moves());
  }
}

// The motor's velocity jumps where the compliance does. For a sine of 0.3 rad at 2 Hz the jump takes less than 1 N.m, the sine's own change
// of torque included.
TEST(MotorPlanner, StepsItsTorqueLittleWhereTheSlopesOfTheSpringChange) {
  MotorPlannerConfig config = config_for(0.267, 1.0);
  config.joint.spring = find_gear("csf-17-50")->spring;
  constexpr double kAmplitude_rad = 0.3, kOmega_rad_s = 2.0 * std::numbers::pi * 2.0;
  const double most_Nm = config.joint.link_inertia_kgm2 * kAmplitude_rad * kOmega_rad_s * kOmega_rad_s;
  ASSERT_GT(most_Nm, config.joint.spring.torque_2_Nm) << "otherwise the sine does not reach every slope";
  MotorPlanner motion(config);
  motion.reset(0.0, kAmplitude_rad * kOmega_rad_s);
  const auto velocity = [&](int k) {
    return kAmplitude_rad * kOmega_rad_s * std::cos(kOmega_rad_s * k * kPeriod_s);
  };
  double last_Nm = 0.0, largest_Nm = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double torque_Nm = step(motion, {kAmplitude_rad * std::sin(kOmega_rad_s * k * kPeriod_s),
                                           velocity(k), (velocity(k + 1) - velocity(k)) / kPeriod_s})
                                 .torque_Nm;
    if (k > 100) largest_Nm = std::max(largest_Nm, std::abs(torque_Nm - last_Nm));
    last_Nm = torque_Nm;
  }
  EXPECT_LT(largest_Nm, 1.0);
}

}  // namespace
}  // namespace strainwave
