// SPDX-License-Identifier: BSD-3-Clause
// Each switched-off part of the controller changes the results. Otherwise `strainwave-sim ablation` would compare a controller with itself.
#include "sim/studies/ablation.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace strainwave {
namespace {

/// Whether the two controllers behave differently on a few joints of the grid, configured correctly or wrongly.
bool differ(const Contender& complete, const Contender& without) {
  for (const auto& cells : {flexible_grid(), wrongly_configured_grid()})
    for (std::size_t i = 3; i < cells.size(); i += 67) {
      const FlexibleResult before = run_without_limit(cells[i], complete);
      const FlexibleResult after = run_without_limit(cells[i], without);
      for (const auto figure : {&FlexibleResult::link_ratio, &FlexibleResult::overshoot_rad,
                                &FlexibleResult::rest_rms_Nm, &FlexibleResult::rest_error_rad})
        if (after.*figure != before.*figure) return true;
    }
  return false;
}

TEST(Ablation, ChangesTheJointsBehaviourWithEveryPartThatIsSwitchedOff) {
  const FlexibleTables tables = read_flexible_tables(STRAINWAVE_SOURCE_DIR "/data/tables");
  const Contender complete = daemon_contender(tables);
  EXPECT_FALSE(differ(complete, daemon_contender(tables, Mechanism::kNone)));
  for (const Mechanism mechanism : kMechanisms)
    if (mechanism != Mechanism::kNone) {
      EXPECT_TRUE(differ(complete, daemon_contender(tables, mechanism))) << name_of(mechanism);
    }
}

TEST(Ablation, NamesEveryPartDifferently) {
  std::set<std::string_view> names;
  for (const Mechanism mechanism : kMechanisms) names.insert(name_of(mechanism));
  EXPECT_EQ(names.size(), kMechanisms.size());
}

TEST(Ablation, TakesTheFigureThatSuffersMostAsTheWorthOfAPart) {
  AblationRow complete;
  complete.step_sums = {1.0, 2.0, 3.0, 4.0};
  complete.overshoot_rad = complete.rest_torque_Nm = complete.unsettled = complete.wrong_off = 1.0;
  complete.wrong_worst_rad = complete.wrong_overshoot_rad = complete.random_rest_rad = 1.0;
  complete.load_rest_rad = 1.0;
  complete.first_rms_rad = complete.sixth_rms_rad = 1.0;
  AblationRow without = complete;
  without.step_sums[1] = 2.5;
  without.sixth_rms_rad = 1.1;
  EXPECT_DOUBLE_EQ(worth(without, complete), 0.25);
}

}  // namespace
}  // namespace strainwave
