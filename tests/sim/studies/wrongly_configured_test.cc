// SPDX-License-Identifier: BSD-3-Clause
// Joints that are configured wrongly, of the whole grid and of a thousand joints drawn at random.
#include "sim/studies/wrongly_configured.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace strainwave {
namespace {

Contender daemon_controller() {
  return daemon_contender(
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables"));
}

// Load, stiffness, friction or jitter, each alone: the link rests within 1.5 mrad, most within 0.3. A delay of one period more than configured is
// for tables that are designed for it.
TEST(WronglyConfigured, EveryJointOfTheGridRestsNearItsTarget) {
  std::map<std::string, double> worst_rad;
  for (const WronglyConfiguredRow& row :
       run_wrongly_configured(wrongly_configured_grid(), daemon_controller())) {
    EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    if (row.cell.effect == "one period of delay more") continue;
    EXPECT_FALSE(row.result.switched_off) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    double& worst = worst_rad[row.cell.effect];
    worst = std::max(worst, row.result.rest_error_rad);
  }
  for (const auto& [effect, worst] : worst_rad) EXPECT_LE(worst, 1.5e-3) << effect;
}

TEST(WronglyConfigured, NineteenOfTwentyRandomJointsRestWithinFourTenthsOfAMilliradianAndNoneOscillates) {
  const auto rows = run_wrongly_configured(wrongly_configured_joints(300, 1), daemon_controller());
  std::vector<double> rest_rad;
  for (const WronglyConfiguredRow& row : rows) {
    EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
    rest_rad.push_back(row.result.rest_error_rad);
  }
  std::sort(rest_rad.begin(), rest_rad.end());
  EXPECT_LE(rest_rad[rest_rad.size() * 19 / 20], 0.4e-3);
}

}  // namespace
}  // namespace strainwave
