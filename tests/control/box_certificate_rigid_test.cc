// SPDX-License-Identifier: BSD-3-Clause
// Stability certificates of rigid joints.
#include "control/table/box_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "base/input_error.h"
#include "control/joint/gear_catalogue.h"
#include "control/table/gain_table_json.h"
#include "tests/support/eigenvalues.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

// Tables with an integrator and without.
TEST(RigidBox, ProvesTheShippedTablesOfRigidJoints) {
  for (const char* const name : {"rhs17-6006", "total-0.119/c1", "total-0.356/c2", "total-1.089/c4"}) {
    const GainTable table = testing::shipped_table(name);
    EXPECT_EQ(table.box.most_delay, kMaxBoxDelay);
    const BoxReport report = certify_box(table);
    EXPECT_TRUE(report.certified) << name << ": " << report.text;
  }
}

// Checks the certified statement with the rigid joint's exact solution and a hand-written loop: V falls in every period, for any viscous
// friction and any blend of gains.
TEST(RigidBox, VOfARigidJointFallsInEveryPeriodOfTheLoopThatRuns) {
  const GainTable table = testing::shipped_table("rhs17-6006");
  const std::vector<GainRow> gains = gains_of(table);
  std::mt19937_64 random(3);
  const auto any = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  for (int i = 0; i < table.box.cell_count; ++i) {
    const BoxCell& cell = table.box.cells[static_cast<std::size_t>(i)];
    const ProofMatrix P = lyapunov_of(table, cell);
    const auto d = static_cast<std::size_t>(cell.delay_periods);
    double least_fall = 1.0;
    for (int run = 0; run < 50; ++run) {
      StateVector x(any(-1e-2, 1e-2), any(-1.0, 1.0), any(-10.0, 10.0));
      double before = any(-1.0, 1.0);
      std::vector<double> torques(d, any(-100.0, 100.0));  // the latest first
      const auto level = [&] {
        ProofMatrix state(4 + static_cast<Eigen::Index>(d), 1);
        state.topRows(3) = x;
        state(3) = before;
        for (std::size_t k = 0; k < d; ++k) state(4 + static_cast<Eigen::Index>(k)) = torques[k];
        return state.transpose().lazyProduct(P).lazyProduct(state)(0, 0);
      };
      for (int k = 0; k < 200; ++k) {
        const double V = level();
        const double share = any(0.0, 1.0);
        const GainRow F =
            share * gains[random() % gains.size()] + (1.0 - share) * gains[random() % gains.size()];
        const double viscous = any(1e-3, table.friction.largest_viscous_Nms_rad());
        const double rate_1_s = viscous / table.plant.inertia_kgm2;
        const double h = table.plant.period_s;
        const double by_speed_s = -std::expm1(-rate_1_s * h) / rate_1_s;
        torques.insert(torques.begin(),
                       F(0) * x(0) + F(1) * x(1) + F(2) * (x(1) - before) / table.plant.period_s);
        before = x(1);
        x = StateVector(
            x(0) + h * x(1), x(1) + by_speed_s * x(2) + (h - by_speed_s) / viscous * torques.back(),
            std::exp(-rate_1_s * h) * x(2) + by_speed_s / table.plant.inertia_kgm2 * torques.back());
        torques.pop_back();
        least_fall = std::min(least_fall, 1.0 - level() / V);
      }
    }
    EXPECT_GT(least_fall, 0.0) << "delay " << d;
  }
}

TEST(RigidBox, ARigidBoxWithANumberIsADefect) {
  GainTable table = testing::shipped_table("csf-17-50");
  table.box.cells[static_cast<std::size_t>(table.box.cell_count)].P[3] = 1.0;
  EXPECT_NE(find_defect(table).value_or("").find("must be 0"), std::string::npos);
  table = testing::shipped_table("csf-17-50");
  table.box.cell_count = 0;
  EXPECT_NE(find_defect(table).value_or("").find("box.cells = 0: must be a list of 1 to 24"),
            std::string::npos);
  table = testing::shipped_table("csf-17-50");
  table.box.cells[0].delay_periods = kMaxBoxDelay + 1;
  EXPECT_NE(find_defect(table), std::nullopt);
}

}  // namespace
}  // namespace strainwave
