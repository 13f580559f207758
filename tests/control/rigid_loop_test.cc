// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/rigid_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "control/table/ts_plant.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

/// Runs the loop as the daemon does: how much larger the error is after so many periods.
double growth(const GainTable& table, const GainRow& gain, int delay_periods, int periods) {
  const SampledDynamics plant = sampled_dynamics(table.plant, 0.0, true);
  StateVector x(0.0, 1.0, 0.0);
  double before = 1.0;
  std::vector<double> torques(static_cast<std::size_t>(delay_periods), 0.0);
  for (int i = 0; i < periods; ++i) {
    torques.push_back(gain(0) * x(0) + gain(1) * x(1) + gain(2) * (x(1) - before) / table.plant.period_s);
    before = x(1);
    x = plant.A * x + plant.B * torques[static_cast<std::size_t>(i)];
  }
  return std::abs(x(1));
}

TEST(RigidLoop, HasTheRadiusWithWhichTheLoopGrows) {
  const GainTable table = testing::shipped_table("rhs17-6006");
  const GainRow stiff = 5.0 * table.primary.gain(0);
  for (const int delay : {1, 2, 3}) {
    const double radius = rigid_loop_radius(table.plant, 0.0, stiff, true, delay);
    EXPECT_NEAR(std::pow(growth(table, stiff, delay, 2000) / growth(table, stiff, delay, 1000), 1e-3), radius,
                1e-3)
        << "delay " << delay;
  }
}

TEST(RigidLoop, IsStableWithTheShippedTableAtEveryDelayThatItIsFor) {
  EXPECT_EQ(find_swing(testing::shipped_table("rhs17-6006"), 0, 3), std::nullopt);
}

TEST(RigidLoop, FindsGainsThatAreStableWithoutDelayAlone) {
  GainTable table = testing::shipped_table("rhs17-6006");
  for (auto& row : table.primary.F)
    for (double& gain : row) gain *= 5.0;
  EXPECT_EQ(find_swing(table, 0, 0), std::nullopt);
  const auto swing = find_swing(table, 0, 1);
  ASSERT_TRUE(swing);
  EXPECT_NE(swing->find("at a delay of 1 periods"), std::string::npos) << *swing;
}

}  // namespace
}  // namespace strainwave
