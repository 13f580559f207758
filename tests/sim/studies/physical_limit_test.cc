// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/physical_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "sim/joint/reference_plant.h"
#include "sim/studies/time_optimal.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

ClosedLoopConfig step_of(const JointPlantConfig& plant, double setpoint_rad) {
  ClosedLoopConfig config;
  config.plant = plant;
  config.ambient = TemperatureProfile::constant(20.0);
  config.setpoint_rad = TimeProfile::constant(setpoint_rad, {"setpoint_position_rad"});
  config.duration_s = 0.5;
  return config;
}

std::string refusal(const ClosedLoopConfig& config) {
  return testing::refusal_of([&] { physical_limit(config); });
}

TEST(PhysicalLimit, IsTheTimeOptimalMotionOfARigidJointAndTheBestMotionOfALink) {
  const ClosedLoopConfig rigid = step_of(realistic_plant(), 0.1);
  EXPECT_EQ(physical_limit(rigid).pi2, run_time_optimal(rigid).statistics.pi2);
  const ClosedLoopConfig flexible = step_of(flexible_plant(), 0.1);
  const LinkLimit best = find_link_limit(link_limit_of_run(flexible));
  EXPECT_NEAR(physical_limit(flexible).pi2, best.pi2, 1e-9);
  EXPECT_NEAR(physical_limit(flexible).counted_pi2.value(), best.counted_pi2, 1e-9);
}

TEST(PhysicalLimit, OfARunThatEndsEarlierCountsItsSamplesOnly) {
  ClosedLoopConfig config = step_of(flexible_plant(), 0.1);
  const double whole = physical_limit(config).pi2;
  config.duration_s = 0.02;
  EXPECT_LT(physical_limit(config).pi2, whole);
  EXPECT_LE(physical_limit(config).pi2, 20.0);
}

TEST(PhysicalLimit, SeesFromWhereTheJointStarts) {
  ClosedLoopConfig from_afar = step_of(flexible_plant(), 0.3);
  from_afar.plant.initial_position_rad = 0.2;
  EXPECT_NEAR(0.3 * physical_limit(from_afar).pi2, 0.1 * physical_limit(step_of(flexible_plant(), 0.1)).pi2,
              1e-6);
}

TEST(PhysicalLimit, IsHigherWithALinkThatTurnsInOil) {
  ClosedLoopConfig oil = step_of(flexible_plant(), 0.1);
  const double dry = physical_limit(oil).pi2;
  oil.plant.effects.transmission->link_viscous_Nms_rad = 5.0;
  EXPECT_GT(physical_limit(oil).pi2, 1.02 * dry);
}

TEST(PhysicalLimit, NamesEveryEffectThatItCannotTake) {
  using Change = std::function<void(JointEffects&)>;
  const std::pair<const char*, Change> both[] = {
      {"gravity.torque_Nm = 3", [](JointEffects& e) { e.gravity.torque_Nm = 3.0; }},
      {"contact.stiffness_Nm_rad = 100",
       [](JointEffects& e) {
         e.contact = {1.0, 100.0, 0.0};
       }},
      {"sliding.presliding_rad = 0.1", [](JointEffects& e) { e.friction.presliding_rad = 0.1; }},
      {"sliding.direction_share = -0.3", [](JointEffects& e) { e.friction.direction_share = -0.3; }},
      {"drive.current_loop_s = 5e-04", [](JointEffects& e) { e.drive.current_loop_s = 5e-4; }},
      {"drive.ripple_share = 0.02", [](JointEffects& e) { e.drive.ripple_share = 0.02; }}};
  for (const JointPlantConfig& plant : {realistic_plant(), flexible_plant()})
    for (const auto& [named, change] : both) {
      ClosedLoopConfig config = step_of(plant, 0.1);
      change(config.plant.effects);
      EXPECT_NE(refusal(config).find(named), std::string::npos) << refusal(config);
      EXPECT_NE(refusal(config).find("0 is allowed"), std::string::npos) << refusal(config);
    }
  const std::pair<const char*, Change> of_links[] = {
      {"link.coulomb_Nm", [](JointEffects& e) { e.transmission->link_coulomb_Nm = 0.5; }},
      {"spring.lost_motion_rad", [](JointEffects& e) { e.transmission->lost_motion.width_rad = 1e-4; }},
      {"kinematic_error.once_rad",
       [](JointEffects& e) { e.transmission->kinematic_error.amplitude_rad[0] = 1e-4; }},
      {"kinematic_error.twice_rad",
       [](JointEffects& e) { e.transmission->kinematic_error.amplitude_rad[1] = 1e-4; }},
      {"sliding.transmitted_share", [](JointEffects& e) { e.friction.transmitted_share = 0.06; }}};
  for (const auto& [named, change] : of_links) {
    ClosedLoopConfig config = step_of(flexible_plant(), 0.1);
    change(config.plant.effects);
    EXPECT_NE(refusal(config).find(named), std::string::npos) << refusal(config);
  }
}

TEST(PhysicalLimit, OfALinkRefusesWhatChangesDuringTheRunAndTakesAConstantLoad) {
  ClosedLoopConfig config = step_of(flexible_plant(), 0.1);
  const double free = physical_limit(config).pi2;
  config.load_torque_Nm = TimeProfile::constant(5.0, {"load_torque_Nm"});
  EXPECT_GT(physical_limit(config).pi2, free);
  config.load_torque_Nm = TimeProfile::steps(0.0, 5.0, 0.1, 1.0, {"load_torque_Nm"});
  EXPECT_NE(refusal(config).find("load_torque_Nm = 5 at 0.1"), std::string::npos) << refusal(config);
  config = step_of(flexible_plant(), 0.1);
  config.setpoint_rad = TimeProfile::ramp(0.0, 1.0, 0.0, 1.0, {"setpoint_position_rad"});
  EXPECT_NE(refusal(config).find("reference_rad"), std::string::npos) << refusal(config);
  config = step_of(flexible_plant(), 0.1);
  config.ambient = TemperatureProfile::parse("ramp:-10,45,0,1");
  EXPECT_NE(refusal(config).find("ambient_temperature_C"), std::string::npos) << refusal(config);
}

TEST(PhysicalLimit, SaysHowFarAMotionMayGoThatTakesTooLongToSolve) {
  const std::string far = refusal(step_of(flexible_plant(), 10.0));
  EXPECT_NE(far.find("step_rad = 10:"), std::string::npos) << far;
  EXPECT_NE(far.find("must be below 5."), std::string::npos) << far;
  ClosedLoopConfig sticky = step_of(flexible_plant(), 1.0);
  sticky.plant.joint.friction.asymptote.viscous_Nms_rad = 1000.0;
  EXPECT_NE(refusal(sticky).find("must be below 0.02"), std::string::npos) << refusal(sticky);
}

}  // namespace
}  // namespace strainwave
