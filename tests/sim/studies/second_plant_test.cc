// SPDX-License-Identifier: BSD-3-Clause
// The controllers of the flexible study on the joint of tests/support/two_mass_joint.h, which shares nothing with the simulator. So the
// study's figures do not depend on the numerical integration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/units.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/link_limit.h"
#include "tests/support/two_mass_joint.h"

namespace strainwave {
namespace {

constexpr int kPeriods = 2000;

TwoMassData second_joint(const FlexibleCell& cell) {
  const JointPlantConfig& plant = cell.plant;
  const Transmission& gear = *plant.effects.transmission;
  const FrictionParameters friction = plant.joint.friction.at(cell.temperature_C);
  TwoMassData data;
  data.motor_kgm2 = plant.joint.inertia_kgm2;
  data.link_kgm2 = gear.link_inertia_kgm2;
  data.slopes_Nm_rad = {gear.spring.stiffness_1_Nm_rad, gear.spring.stiffness_2_Nm_rad,
                        gear.spring.stiffness_3_Nm_rad};
  data.corners_Nm = {gear.spring.torque_1_Nm, gear.spring.torque_2_Nm};
  data.damping_Nms_rad = gear.damping_Nms_rad;
  data.static_Nm = friction.static_Nm;
  data.coulomb_Nm = friction.coulomb_Nm;
  data.viscous_Nms_rad = friction.viscous_Nms_rad;
  data.stribeck_rad_s = plant.joint.stribeck.velocity_rad_s;
  data.peak_Nm = plant.motor.peak_torque_Nm;
  data.stall_Nm = plant.motor.stall_torque_Nm;
  data.torque_per_speed_Nms_rad = plant.motor.torque_per_speed_Nms_rad;
  data.delay_periods = static_cast<int>(std::lround(plant.delay.periods));
  data.counts_per_revolution = plant.encoder.counts_per_joint_revolution;
  return data;
}

struct Figures {
  double counted = 0.0;  ///< sum |e / r| of the link above 40 urad
  double overshoot_rad = 0.0;
  double rest_swing_rad = 0.0;
  int rest_sign_changes = 0;
};

Figures on_the_second_plant(const FlexibleCell& cell, const Contender& contender) {
  const auto controller = contender.make(cell.nominal);
  controller->reset();
  TwoMassJoint joint(second_joint(cell));
  Figures figures;
  double low = 1e9, high = -1e9, last_sign = 0.0;
  for (int k = 0; k < kPeriods; ++k) {
    const double error_rad = cell.step_rad - joint.link_rad();
    if (std::abs(error_rad) > kCountedError_rad) figures.counted += std::abs(error_rad / cell.step_rad);
    figures.overshoot_rad = std::max(figures.overshoot_rad, -error_rad);
    LoopSample sample;
    sample.time_s = k * TwoMassJoint::kPeriod_s;
    sample.setpoint_position_rad = cell.step_rad;
    sample.joint_position_rad = joint.reading_rad();
    sample.temperature_C = cell.temperature_C;
    const double torque_Nm = controller->torque_Nm(sample);
    joint.step(torque_Nm);
    if (k < kPeriods * 3 / 4) continue;
    low = std::min(low, joint.link_rad());
    high = std::max(high, joint.link_rad());
    if (sign(torque_Nm) * last_sign < 0.0) ++figures.rest_sign_changes;
    if (torque_Nm != 0.0) last_sign = sign(torque_Nm);
  }
  figures.rest_swing_rad = high - low;
  return figures;
}

Figures of_the_study(const FlexibleCell& cell, const Contender& contender) {
  Figures figures;
  for (const TracePoint& point : run_cell(cell, contender).trace) {
    const double error_rad = cell.step_rad - point.link_position_rad;
    if (std::abs(error_rad) > kCountedError_rad) figures.counted += std::abs(error_rad / cell.step_rad);
    figures.overshoot_rad = std::max(figures.overshoot_rad, -error_rad);
  }
  return figures;
}

std::vector<Contender> daemon_contenders() {
  const FlexibleTables tables =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  std::vector<Contender> kept;
  for (const Contender& contender : flexible_contenders(tables, false))
    if (contender.name.rfind("daemon", 0) == 0) kept.push_back(contender);
  return kept;
}

bool oscillates(const Figures& figures) {
  const double rest_s = kPeriods / 4 * TwoMassJoint::kPeriod_s;
  return figures.rest_swing_rad > kOscillation_rad &&
         figures.rest_sign_changes > kOscillationSignChanges_Hz * rest_s;
}

TEST(SecondPlant, ShowsTheFiguresOfTheStudy) {
  int compared = 0;
  for (const Contender& contender : daemon_contenders())
    for (const FlexibleCell& cell : flexible_grid()) {
      const bool taken = cell.damping_ratio == 0.03 && cell.stiffness_scale == 1.0 &&
                         cell.link_inertia_kgm2 < 0.5 &&
                         (cell.temperature_C == -10.0 || cell.temperature_C == 20.0) && cell.step_rad >= 0.1;
      if (!taken) continue;
      const Figures here = on_the_second_plant(cell, contender);
      const Figures there = of_the_study(cell, contender);
      const auto which = ::testing::Message() << contender.name << ", link " << cell.link_inertia_kgm2 << ", "
                                              << cell.temperature_C << " degC, " << cell.step_rad << " rad";
      EXPECT_NEAR(here.counted / there.counted, 1.0, 0.01) << which;
      EXPECT_NEAR(here.overshoot_rad, there.overshoot_rad, 0.01 * cell.step_rad) << which;
      ++compared;
    }
  EXPECT_EQ(compared, 12);
}

TEST(SecondPlant, NoJointDrawnAtRandomOscillatesOnIt) {
  std::mt19937 random(20061);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random()), -32);
  };
  const std::vector<FlexibleCell> grid = flexible_grid();
  for (int i = 0; i < 60; ++i) {
    FlexibleCell cell = grid[random() % grid.size()];
    // The joint differs from its configuration.
    Transmission& gear = *cell.plant.effects.transmission;
    gear.link_inertia_kgm2 *= between(0.7, 1.3);
    gear.spring = gear.spring.scaled(between(0.75, 1.25));
    const double friction = between(0.7, 1.3);
    for (FrictionParameters* part :
         {&cell.plant.joint.friction.asymptote, &cell.plant.joint.friction.amplitude})
      *part = {friction * part->static_Nm, friction * part->coulomb_Nm, friction * part->viscous_Nms_rad};
    for (const Contender& contender : daemon_contenders()) {
      const Figures figures = on_the_second_plant(cell, contender);
      EXPECT_FALSE(oscillates(figures))
          << contender.name << ", joint " << i << ": " << figures.rest_swing_rad;
      EXPECT_LT(figures.overshoot_rad, cell.step_rad + 5e-3) << contender.name << ", joint " << i;
    }
  }
}

}  // namespace
}  // namespace strainwave
