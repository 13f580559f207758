// SPDX-License-Identifier: BSD-3-Clause
// The default load limit of a joint. A push on a joint that holds exceeds it before it takes all of the
// torque; a sound joint's own torques do not exceed it. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "daemon/config/config_load.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/flexible_study.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kMotor_kgm2 = 0.089;

const GainTable& spring_table(double total_kgm2) {
  static const FlexibleTables tables =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  return FlexibleTables::nearest(tables.c4, total_kgm2);
}

/// `joint` with the load limits of a configuration without keys for loads.
BenchJoint with_usual_load(BenchJoint joint, double inertia_kgm2) {
  JointConfig configured;
  configured.loop = joint.loop;
  configured.plant.inertia_kgm2 = inertia_kgm2;
  joint.loop.limits.load = {{}, {}, usual_load(configured)};
  return joint;
}

/// A flexible joint like `plant`.
BenchJoint on_a_spring(const JointPlantConfig& plant) {
  BenchJoint joint = demo_joint();
  put_on_spring(joint, plant);
  return joint;
}

/// A hand pushes on a joint that holds, with 10 N.m more each second. Returns the largest torque as a share of the limit that holds.
double lean_on(const BenchJoint& joint, const GainTable& table, const char* name) {
  const double torque_limit_Nm = joint.loop.controller.torque_limit_with(table);
  const double load_Nm = joint.loop.limits.load.under(torque_limit_Nm).load_Nm;
  JointBench bench({joint});
  bench.bring_to_hold(0, table);
  double largest_Nm = 0.0;
  double noticed_Nm = 0.0;
  double push_Nm = 0.0;
  for (int k = 0; k < 4000 && bench.fault(0) == Fault::kNone; ++k) {
    push_Nm = 0.01 * k;
    bench.drive(0).simulated().set_load_torque_Nm(push_Nm);
    bench.step();
    largest_Nm = std::max(largest_Nm, std::abs(bench.state(0).torque_commanded_Nm));
    if (noticed_Nm == 0.0 && bench.has_notice(0, Notice::kLoadHigh)) noticed_Nm = push_Nm;
  }
  EXPECT_EQ(bench.fault(0), Fault::kOverload) << name;
  EXPECT_NEAR(push_Nm, load_Nm, 3.0) << name << ": but for friction, which holds as well";
  EXPECT_NEAR(noticed_Nm, 0.8 * load_Nm, 3.0) << name;
  EXPECT_LT(push_Nm, 0.9 * torque_limit_Nm) << name;
  return largest_Nm / torque_limit_Nm;
}

TEST(UsualLoad, LetsAJointGoOfAPushThatGrowsSlowly) {
  EXPECT_LT(lean_on(with_usual_load(demo_joint(), kMotor_kgm2), demo_table(), "rigid"), 0.9);
  const double total_kgm2 = 2.0 * kMotor_kgm2;
  // Its small corrections of the position take as much torque as its acceleration requires.
  EXPECT_LE(lean_on(with_usual_load(on_a_spring(flexible_plant()), total_kgm2), spring_table(total_kgm2),
                    "flexible"),
            1.0);
}

GainTable demo_table_with(double torque_limit_Nm) {
  GainTable table = demo_table();
  table.torque_limit_Nm = torque_limit_Nm;
  return table;
}

TEST(UsualLoad, FollowsTheTableThatComesLater) {
  JointBench bench({with_usual_load(demo_joint(), kMotor_kgm2)});
  bench.bring_to_hold(0, demo_table_with(20.0));
  const auto load = [&](std::size_t slot, double torque_limit_Nm) {
    bench.joint(0).table_slot(slot) = {demo_table_with(torque_limit_Nm), 2};
    return bench.order(0, Order{.kind = OrderKind::kUseTable, .table_slot = static_cast<int>(slot)});
  };
  const auto fault_of_push = [&](double push_Nm) {
    bench.drive(0).simulated().set_load_torque_Nm(push_Nm);
    bench.run(1.0);
    return bench.fault(0);
  };
  ASSERT_EQ(load(1, 34.0), Reason::kAccepted);
  EXPECT_EQ(fault_of_push(14.0), Fault::kNone) << "10 N.m are for the table before";
  EXPECT_EQ(load(2, 20.0), Reason::kOutOfRange) << "the joint would fall";
  EXPECT_EQ(fault_of_push(0.0), Fault::kNone);
  ASSERT_EQ(load(2, 20.0), Reason::kAccepted);
  EXPECT_EQ(fault_of_push(14.0), Fault::kOverload);
}

/// Moves to and fro by `step_rad` at the joint's full speed. Returns whether a high load was noticed. An overload fails the test.
bool notices_load(BenchJoint joint, const GainTable& table, double temperature_C, double step_rad) {
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  JointBench bench({joint});
  bench.bring_to_hold(0, table);
  bench.run(0.5);
  bool noticed = false;
  for (int k = 0; k < 3000 && bench.fault(0) == Fault::kNone; ++k) {
    if (k % 1000 == 0)
      EXPECT_EQ(bench.move(0, k % 2000 == 0 ? step_rad : 0.0), Reason::kAccepted);
    else
      bench.step();
    noticed = noticed || bench.has_notice(0, Notice::kLoadHigh);
  }
  EXPECT_NE(bench.fault(0), Fault::kOverload) << temperature_C << " degC, " << step_rad << " rad";
  return noticed;
}

// Every fifth cell of the study, at 6 rad/s and 150 rad/s^2.
TEST(UsualLoad, IsNotWhatASpringShows) {
  const std::vector<FlexibleCell> grid = flexible_grid();
  for (std::size_t i = 0; i < grid.size(); i += 5) {
    const FlexibleCell& cell = grid[i];
    const double total_kgm2 = cell.plant.joint.inertia_kgm2 + cell.link_inertia_kgm2;
    EXPECT_FALSE(notices_load(with_usual_load(on_a_spring(cell.plant), total_kgm2), spring_table(total_kgm2),
                              cell.temperature_C, cell.step_rad))
        << "cell " << i;
  }
}

// If the torque is small, friction takes most of it: 5.8 of 8 N.m at -10 degC.
TEST(UsualLoad, IsNotWhatFrictionOrAccelerationShows) {
  for (const double torque_limit_Nm : {34.0, 8.0}) {
    int notices = 0;
    for (const double temperature_C : {-10.0, 0.0, 20.0, 40.0})
      for (const double acceleration_rad_s2 : {2.0, 30.0, 150.0})
        for (const double step_rad : {0.01, 0.1, 1.0})
          for (const bool rigid : {true, false}) {
            BenchJoint joint = rigid ? demo_joint() : on_a_spring(flexible_plant());
            joint.loop.controller.torque_limit_Nm = torque_limit_Nm;
            joint.loop.controller.motion = {6.0, acceleration_rad_s2, acceleration_rad_s2};
            const double total_kgm2 = rigid ? kMotor_kgm2 : 2.0 * kMotor_kgm2;
            const GainTable& table = rigid ? demo_table() : spring_table(total_kgm2);
            notices +=
                notices_load(with_usual_load(joint, total_kgm2), table, temperature_C, step_rad) ? 1 : 0;
          }
    EXPECT_LE(notices, torque_limit_Nm > 10.0 ? 0 : 2) << torque_limit_Nm;
  }
}

}  // namespace
}  // namespace strainwave::testing
