// SPDX-License-Identifier: BSD-3-Clause
// The controller of a flexible joint: cases that the studies (tests/sim/studies) do not cover. The friction and the spring of the simulated
// joint differ from the controller's model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/control/controlled_joint.h"

namespace strainwave {
namespace {

constexpr double kBand_rad = 40e-6;

JointPlantConfig plant_with(double link_kgm2) {
  JointPlantConfig plant = flexible_plant();
  plant.effects.transmission->link_inertia_kgm2 = link_kgm2;
  return plant;
}

JointControllerConfig config_for(const JointPlantConfig& plant) {
  const Transmission& gear = *plant.effects.transmission;
  JointControllerConfig config;
  config.encoder_resolution_rad = plant.encoder.resolution_rad();
  config.delay_periods = static_cast<int>(std::lround(plant.delay.periods));
  config.torque_limit_Nm = kReferencePeakTorque_Nm;
  config.motor = plant.motor;
  config.motion = {100.0, 1e4, 1e4};
  config.link = {plant.joint.inertia_kgm2, gear.link_inertia_kgm2, gear.spring, gear.damping_Nms_rad, {}};
  config.gravity = plant.effects.gravity;
  return config;
}

JointPlantConfig with_friction(JointPlantConfig plant, double scale) {
  for (FrictionParameters* part : {&plant.joint.friction.asymptote, &plant.joint.friction.amplitude})
    *part = {scale * part->static_Nm, scale * part->coulomb_Nm, scale * part->viscous_Nms_rad};
  return plant;
}

/// The simulated joint `plant` under a controller that is configured for `told`.
class Loop : public testing::ControlledJoint {
 public:
  Loop(const JointPlantConfig& plant, const JointPlantConfig& told, double at_C,
       const char* table = "total-0.178/c4.json")
      : ControlledJoint(plant, config_for(told), table, at_C) {}
};

struct Outcome {
  double overshoot_rad = 0.0;
  double swing_at_rest_rad = 0.0;
  double final_error_rad = 0.0;
  int corrections = 0;
  bool oscillates = false;
};

Outcome move(Loop& loop, double target_rad) {
  loop.controller().set_target(target_rad);
  Outcome outcome;
  double low = 1e9;
  double high = -1e9;
  for (int k = 0; k < 2000; ++k) {
    const JointStep step = loop.step();
    outcome.overshoot_rad = std::max(outcome.overshoot_rad, loop.position_rad() - target_rad);
    outcome.corrections = step.corrections;
    outcome.oscillates = step.oscillates;
    if (k < 1500) continue;
    low = std::min(low, loop.position_rad());
    high = std::max(high, loop.position_rad());
  }
  outcome.swing_at_rest_rad = high - low;
  outcome.final_error_rad = loop.position_rad() - target_rad;
  return outcome;
}

// Without the configured damping the plan assumes an undamped spring. A move of 0.001 rad overshoots by three counts at most either way.
TEST(JointControllerWithLink, OvershootsLessWhereTheDampingIsConfigured) {
  for (const double target : {0.01, 0.1, 1.0}) {
    JointPlantConfig plant = plant_with(0.267);
    plant.effects.transmission->damping_Nms_rad = structural_damping_Nms_rad(0.089, 0.267, 8100.0, 0.1);
    JointPlantConfig undamped = plant;
    undamped.effects.transmission->damping_Nms_rad = 0.0;
    Loop without(plant, undamped, 20.0);
    Loop with(plant, plant, 20.0);
    const double without_rad = move(without, target).overshoot_rad;
    EXPECT_LT(move(with, target).overshoot_rad, 0.6 * without_rad) << target;
  }
}

TEST(JointControllerWithLink, CorrectsFromRestAndIsNotSupervisedByItsCorrections) {
  const JointPlantConfig told = plant_with(0.089);
  Loop loop(with_friction(told, 1.3), told, 0.0);
  loop.controller().set_target(0.01);
  int corrections = 0;
  double standing_rad = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const JointStep step = loop.step();
    if (step.corrections != corrections) {
      EXPECT_EQ(step.joint_velocity_rad_s, 0.0) << "a correction that does not begin from rest";
      corrections = step.corrections;
    }
    if (corrections > 0) {
      EXPECT_EQ(step.ordered_reference.position_rad, 0.01);
    }
    standing_rad = loop.position_rad();
  }
  EXPECT_GT(corrections, 0) << "this friction needs one, or the test shows nothing";
  EXPECT_LE(corrections, 6);
  EXPECT_LE(std::abs(standing_rad - 0.01), kBand_rad);
}

// With little damping and 30 % less friction than configured, the planned torque reverses hard. A swinging link adds to it.
TEST(JointControllerWithLink, SmallMovesOfAHeavyLinkInTheColdAreNoChatter) {
  for (const double link : {0.2, 0.25, 0.3})
    for (const double damping : {0.1, 0.3, 1.0})
      for (const double step : {50e-6, 100e-6, 200e-6, 400e-6, 1e-3}) {
        JointPlantConfig plant = plant_with(link);
        plant.effects.transmission->damping_Nms_rad = damping;
        Loop loop(with_friction(plant, 0.7), plant, -10.0, "csf-17-50.json");
        double target = 0.0;
        for (const double way : {1.0, -1.0, 1.7, 1.0, -0.6, 1.0}) {
          target += way * step;
          const Outcome outcome = move(loop, target);
          const auto which = ::testing::Message() << link << " " << damping << " " << step << " " << way;
          EXPECT_FALSE(outcome.oscillates) << which;
          EXPECT_LE(std::abs(outcome.final_error_rad), 0.5e-3) << which;
          EXPECT_LE(outcome.corrections, 20 * 6) << which;
        }
      }
}

TEST(JointControllerWithLink, ComesToRestAfterASlowMoveWhateverTheFriction) {
  for (const double friction : {0.7, 1.0, 1.3})
    for (const double speed_rad_s : {0.003, 0.01}) {
      Loop loop(with_friction(plant_with(0.089), friction), plant_with(0.089), -10.0);
      loop.controller().set_target(0.02, speed_rad_s);
      const int arrival = static_cast<int>(0.02 / speed_rad_s * 1000.0) + 200;
      for (int k = 0; k < arrival + 2000; ++k) loop.step();
      const int corrections = loop.step().corrections;
      for (int k = 0; k < 1000; ++k) loop.step();
      EXPECT_EQ(loop.step().corrections, corrections) << friction << " " << speed_rad_s;
      EXPECT_LE(corrections, 10) << friction << " " << speed_rad_s;
    }
}

TEST(JointControllerWithLink, AWeightThatItIsToldOfNeitherSagsNorHoldsTheLinkBesideItsTarget) {
  for (const double link : {0.03, 0.267})
    for (const double target : {0.001, 0.1, 1.0}) {
      JointPlantConfig plant = plant_with(link);
      plant.effects.gravity = {10.0, -0.5};
      Loop loop(plant, plant, 0.0);
      const double standing_rad = loop.position_rad();
      for (int k = 0; k < 200; ++k) {
        loop.step();
        // The first torque acts one period late. Until then only friction holds the joint.
        EXPECT_NEAR(loop.position_rad(), standing_rad, 60e-6) << "at the start, period " << k;
      }
      const Outcome outcome = move(loop, standing_rad + target);
      EXPECT_LE(std::abs(outcome.final_error_rad), kBand_rad) << link << " " << target;
      EXPECT_LE(outcome.swing_at_rest_rad, kBand_rad) << link << " " << target;
      EXPECT_FALSE(outcome.oscillates) << link << " " << target;
    }
}

TEST(JointControllerWithLink, BeginsTheMotionInThePeriodOfTheOrder) {
  const JointPlantConfig plant = plant_with(0.089);
  Loop loop(plant, plant, 20.0);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(loop.step().output.torque_Nm, 0.0);
  loop.controller().set_target(0.1);
  EXPECT_GT(loop.step().output.torque_Nm, 5.0);
}

}  // namespace
}  // namespace strainwave
