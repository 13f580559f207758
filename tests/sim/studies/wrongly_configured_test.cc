// SPDX-License-Identifier: BSD-3-Clause
// Wrongly configured joints: from the grid, and at random.
#include "sim/studies/wrongly_configured.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/studies/link_limit.h"

namespace strainwave {
namespace {

const FlexibleTables& shipped_tables() {
  static const FlexibleTables read =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  return read;
}

// With only the load, stiffness, friction or jitter wrong, the link rests within 0.5 mrad. Left out are links below the table's box, which
// the daemon refuses, and one period of delay more than configured, which needs a table designed for it. `strainwave-sim flexible --wrong`
// runs the whole grid.
TEST(WronglyConfigured, EveryFifthJointOfTheGridRestsNearItsTarget) {
  std::vector<FlexibleCell> cells;
  const std::vector<FlexibleCell> grid = wrongly_configured_grid();
  for (std::size_t i = 0; i < grid.size(); i += 5) cells.push_back(grid[i]);
  std::map<std::string, double> worst_rad;
  int wrong_loads = 0;
  int stand_off = 0;
  for (const WronglyConfiguredRow& row : run_wrongly_configured(cells, daemon_contender(shipped_tables()))) {
    EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    const bool wrong_load = row.cell.effect.starts_with("load");
    wrong_loads += wrong_load ? 1 : 0;
    stand_off += wrong_load && row.result.rest_error_rad > kCountedError_rad ? 1 : 0;
    if (row.cell.effect == kOneMorePeriod ||
        row.cell.link_inertia_kgm2 < shipped_tables().shipped.box.link_inertia_kgm2.from)
      continue;
    EXPECT_FALSE(row.result.switched_off) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    double& worst = worst_rad[row.cell.effect];
    worst = std::max(worst, row.result.rest_error_rad);
  }
  for (const auto& [effect, worst] : worst_rad) {
    const bool alone = !effect.starts_with("model") && !effect.starts_with("every");
    EXPECT_LE(worst, alone ? 0.5e-3 : 1.5e-3) << effect;
  }
  // The goal for each of the two wrong loads is 30 of 432 joints. Before friction learning kept the mean of a motion, it was 45 on average.
  EXPECT_LE(432 * stand_off, 30 * wrong_loads);
}

// Gains that are certified for one more period of delay than configured switch off no joint of their box.
TEST(WronglyConfigured, NoJointIsSwitchedOffForOnePeriodOfDelayMoreWithGainsForIt) {
  const auto rows =
      run_wrongly_configured(late_grid(), extended_contender("daemon", shipped_tables().shipped_for_delays));
  EXPECT_EQ(rows.size(), 2U * 288U);
  for (const WronglyConfiguredRow& row : rows) {
    EXPECT_FALSE(row.result.switched_off) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    EXPECT_LE(row.result.rest_error_rad, 1.5e-3)
        << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
  }
}

TEST(WronglyConfigured, RandomJointsRestWithinTheirGoalsAndNoneIsSwitchedOff) {
  const auto rows =
      run_wrongly_configured(wrongly_configured_joints(300, 1), daemon_contender(shipped_tables()));
  std::vector<double> rest_rad;
  for (const WronglyConfiguredRow& row : rows) {
    EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    EXPECT_FALSE(row.result.switched_off) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    rest_rad.push_back(row.result.rest_error_rad);
  }
  std::sort(rest_rad.begin(), rest_rad.end());
  EXPECT_LE(rest_rad[rest_rad.size() * 19 / 20], 0.4e-3);
  EXPECT_LE(rest_rad.back(), 1.5e-3);
}

}  // namespace
}  // namespace strainwave
