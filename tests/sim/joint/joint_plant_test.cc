// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/joint_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/joint/reference_plant.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

TEST(JointPlant, HasTheCatalogueFrictionOfTable3AtTheJoint) {
  // Motor side at T0 + Ts ln 2, where the exponential is one half; ratio 50 makes 1 N.cm half a N.m.
  const FrictionParameters friction = reference_joint().friction.at(-12.803 + 11.28 * std::log(2.0));
  EXPECT_NEAR(friction.static_Nm, 0.5 * (3.1204 + 6.6525 / 2.0), 1e-12);
  EXPECT_NEAR(friction.coulomb_Nm, 0.5 * (1.5204 + 6.6525 / 2.0), 1e-12);
  EXPECT_NEAR(friction.viscous_Nms_rad,
              (0.0011702 + 0.01181 / 2.0) * 2500.0 * 0.01 * 60.0 / (2.0 * 3.14159265358979), 1e-9);
}

TEST(JointPlant, ReadsThePositionInWholeCountsNearestToTheTruth) {
  JointPlant plant(realistic_plant());
  plant.set_ambient_temperature(20.0);
  const double resolution_rad = 2.0 * 3.14159265358979323846 / 320000.0;
  for (int k = 0; k < 200; ++k) {
    plant.step(10.0);
    const double counts = plant.measured_position_rad() / resolution_rad;
    EXPECT_NEAR(counts, std::round(counts), 1e-6);
    EXPECT_LE(std::abs(plant.measured_position_rad() - plant.state().position_rad),
              0.5 * resolution_rad * 1.000001);
  }
  EXPECT_GT(plant.state().position_rad, 100.0 * resolution_rad);
}

TEST(JointPlant, ReadsTheTruthWithAnIdealEncoder) {
  JointPlant plant(ideal_plant());
  plant.set_ambient_temperature(20.0);
  plant.step(10.0);
  EXPECT_EQ(plant.measured_position_rad(), plant.state().position_rad);
}

TEST(JointPlant, ActsOnACommandAsManyPeriodsLaterAsConfigured) {
  constexpr int kMost = static_cast<int>(kMaxDelayPeriods);
  for (const int delay : {0, 1, 3, kMost}) {
    JointPlantConfig config = ideal_plant();
    config.delay.periods = delay;
    JointPlant plant(config);
    plant.set_ambient_temperature(20.0);
    for (int k = 0; k < 2 * kMost; ++k) {
      plant.step(k == 2 ? 10.0 : 0.0);
      EXPECT_EQ(plant.applied_torque_Nm(), k == 2 + delay ? 10.0 : 0.0)
          << "delay " << delay << " period " << k;
    }
  }
}

TEST(JointPlant, ForgetsPendingTorqueWhenTold) {
  JointPlantConfig config = ideal_plant();
  config.delay.periods = 2.0;
  JointPlant plant(config);
  plant.set_ambient_temperature(20.0);
  plant.step(10.0);
  plant.clear_pending_torque();
  for (int k = 0; k < 5; ++k) plant.step(0.0);
  EXPECT_EQ(plant.state().position_rad, 0.0);
}

TEST(JointPlant, MovesMoreEasilyWhenItIsWarm) {
  const auto distance = [](double temperature_C) {
    JointPlant plant(ideal_plant());
    plant.set_ambient_temperature(temperature_C);
    for (int k = 0; k < 100; ++k) plant.step(6.0);
    return plant.state().position_rad;
  };
  EXPECT_GT(distance(0.0), 1.1 * distance(-10.0));
  EXPECT_GT(distance(40.0), 1.1 * distance(0.0));
}

TEST(JointPlant, WarmsTowardsTheThermalResistanceTimesTheLoss) {
  JointPlantConfig config = ideal_plant();
  config.thermal = {1.2, 0.5, 0.0};
  JointPlant plant(config);
  const double torque_Nm = 1.0;  // below static friction: all heat comes from the winding
  const double loss_W = 4.8 * (torque_Nm / 9.6) * (torque_Nm / 9.6);
  for (int k = 0; k < 1000; ++k) {
    plant.set_ambient_temperature(20.0);
    plant.step(torque_Nm);
  }
  plant.set_ambient_temperature(20.0);
  EXPECT_NEAR(plant.joint_temperature_C(), 20.0 - 1.2 * loss_W * std::expm1(-1.0 / 0.5), 1e-12);
  EXPECT_EQ(plant.sensor_temperature_C(), plant.joint_temperature_C());
}

TEST(JointPlant, TurnsTheWorkOfFrictionIntoHeat) {
  JointPlantConfig config = ideal_plant();
  config.winding_loss_W_Nm2 = 0.0;
  config.thermal = {1.2, 1e9, 0.0};     // so slow that nothing flows out
  config.joint.friction.decay_C = 1e9;  // nor does friction change
  JointPlant plant(config);
  plant.set_ambient_temperature(20.0);
  double work_J = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double before_rad = plant.state().position_rad;
    plant.step(10.0);
    work_J += 10.0 * (plant.state().position_rad - before_rad);
  }
  const double kept_J = kinetic_energy(config.joint, plant.state());
  plant.set_ambient_temperature(20.0);
  EXPECT_NEAR((plant.joint_temperature_C() - 20.0) * 1e9 / 1.2, work_J - kept_J, 1e-4 * work_J);
}

TEST(JointPlant, ShowsALaggingTemperature) {
  JointPlantConfig config = ideal_plant();
  config.thermal.sensor_time_constant_s = 0.25;
  JointPlant plant(config);
  plant.set_ambient_temperature(10.0);
  EXPECT_EQ(plant.sensor_temperature_C(), 10.0) << "settled at the start";
  for (int k = 0; k < 250; ++k) plant.set_ambient_temperature(30.0);
  EXPECT_NEAR(plant.sensor_temperature_C(), 30.0 - 20.0 * std::exp(-1.0), 1e-9);
  EXPECT_EQ(plant.joint_temperature_C(), 30.0);
}

TEST(JointPlant, WantsSubstepsThatItsFastestSwingAndDecayBear) {
  const auto message = [](auto&& change) {
    JointPlantConfig config = flexible_plant();
    change(config);
    return testing::refusal_of([&] { JointPlant plant(config); });
  };
  EXPECT_EQ(message([](auto&) {}), "accepted");
  const std::string stiff = message([](auto& c) { c.effects.transmission->spring.stiffness_3_Nm_rad = 1e9; });
  // sqrt(1e9 (1 / 0.089 + 1 / 0.089)) 1 ms = 149.9
  EXPECT_NE(stiff.find("substeps = 10: at least 150"), std::string::npos) << stiff;
  for (const double damping_Nms_rad : {2000.0, 1e9})
    EXPECT_NE(
        message([&](auto& c) { c.effects.transmission->damping_Nms_rad = damping_Nms_rad; }).find("substeps"),
        std::string::npos);
  EXPECT_NE(message([](auto& c) { c.effects.transmission->link_viscous_Nms_rad = 3000.0; }).find("substeps"),
            std::string::npos);
  EXPECT_NE(message([](auto& c) {
              c.effects.contact = {.stiffness_Nm_rad = 1e4, .damping_Nms_rad = 1e9};
            }).find("substeps"),
            std::string::npos);
}

TEST(JointPlant, RefusesAnImpossibleConfigurationByName) {
  const auto message = [](auto&& spoil) {
    JointPlantConfig config = realistic_plant();
    spoil(config);
    return testing::refusal_of([&] { JointPlant plant(config); });
  };
  EXPECT_NE(message([](auto& c) { c.joint.inertia_kgm2 = 0.0; }).find("inertia_kgm2"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.period_s = -1.0; }).find("period_s"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.substeps = 0; }).find("substeps"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.delay.periods = kMaxDelayPeriods + 1.0; }).find("delay_periods"),
            std::string::npos);
  EXPECT_NE(message([](auto& c) { c.motor.peak_torque_Nm = std::nan(""); }).find("peak_torque_Nm"),
            std::string::npos);
  EXPECT_NE(message([](auto& c) { c.encoder.counts_per_joint_revolution = -4.0; }).find("encoder_counts"),
            std::string::npos);
  EXPECT_EQ(message([](auto&) {}), "accepted");
}

}  // namespace
}  // namespace strainwave
