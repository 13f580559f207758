#include "sim/studies/flexible_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace strainwave {
namespace {

const FlexibleTables& tables() {
  static const FlexibleTables read =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  return read;
}

TEST(FlexibleStudy, HasTheGridThatItsPageNames) {
  EXPECT_EQ(flexible_grid().size(), 4U * 3U * 3U * 4U * 4U);
  EXPECT_EQ(first_grid().size(), 96U);
  std::set<std::string> effects;
  for (const FlexibleCell& cell : effect_grid()) effects.insert(cell.effect);
  EXPECT_EQ(effects.size(), 11U + 4U) << "each effect, none, all together, two wrong configurations";
}

TEST(FlexibleStudy, DrawsTheSameJointFromTheSameSeedWhateverTheNumberOfJoints) {
  const auto few = random_joints(3, 7);
  const auto many = random_joints(10, 7);
  const auto others = random_joints(3, 8);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].link_inertia_kgm2, many[i].link_inertia_kgm2);
    EXPECT_EQ(few[i].plant.delay.jitter_periods, many[i].plant.delay.jitter_periods);
    EXPECT_NE(few[i].link_inertia_kgm2, others[i].link_inertia_kgm2);
  }
}

TEST(FlexibleStudy, GivesEachJointTheTableOfItsTotalInertia) {
  for (const GainTable& table : tables().c4)
    EXPECT_EQ(&FlexibleTables::nearest(tables().c4, 1.02 * table.plant.inertia_kgm2), &table);
}

TEST(FlexibleStudy, JudgesNoControllerBetterThanTheLimitOfTheLink) {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : flexible_grid())
    if (cell.damping_ratio == 0.03 && cell.stiffness_scale == 1.0 && cell.temperature_C == 0.0)
      cells.push_back(cell);
  const auto contenders = flexible_contenders(tables(), false);
  std::size_t told = 0;
  const auto rows = run_flexible(cells, contenders, [&](std::size_t done) { told = done; });
  EXPECT_EQ(told, cells.size());
  for (const FlexibleRow& row : rows)
    for (const FlexibleResult& result : row.results) {
      EXPECT_GE(result.link_ratio, 0.99);
      EXPECT_GE(result.link_counted_ratio, 0.95);
      if (result.oscillates) {
        EXPECT_LT(result.settling_time_s, 0.0) << "what swings has not settled";
      }
    }
}

}  // namespace
}  // namespace strainwave
