#include "sim/studies/flexible_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

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

const Contender& contender(const std::string& name) {
  static const auto all = flexible_contenders(tables(), true);
  for (const Contender& candidate : all)
    if (candidate.name == name) return candidate;
  throw std::invalid_argument(name);
}

int oscillating(const std::vector<FlexibleCell>& cells, const Contender& contender) {
  return static_cast<int>(std::count_if(
      cells.begin(), cells.end(), [&](const FlexibleCell& cell) { return oscillates(cell, contender); }));
}

std::vector<FlexibleCell> hardly_damped_cells() {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : flexible_grid())
    if (cell.damping_ratio == 0.01 && cell.stiffness_scale == 1.0) cells.push_back(cell);
  return cells;
}

TEST(FlexibleStudy, FindsNoJointOfTheGridThatOscillatesUnderTheDefaultController) {
  EXPECT_EQ(oscillating(hardly_damped_cells(), contender("daemon")), 0);
}

TEST(FlexibleStudy, FindsNoRandomJointThatOscillatesOrDivergesUnderTheDefaultController) {
  EXPECT_EQ(oscillating(random_joints(100, 1), contender("daemon")), 0);
}

// That the study sees an oscillation where there is one: it is what the first version of this project did.
TEST(FlexibleStudy, FindsTheOscillationsOfEveryPartOnWithoutTheMonitorOnHeavyLinks) {
  std::vector<FlexibleCell> light;
  std::vector<FlexibleCell> heavy;
  for (const FlexibleCell& cell : first_grid()) {
    if (cell.link_inertia_kgm2 < 0.05) light.push_back(cell);
    if (cell.link_inertia_kgm2 > 0.2) heavy.push_back(cell);
  }
  EXPECT_LE(oscillating(light, unwatched_contender(tables())), 3);
  EXPECT_GE(oscillating(heavy, unwatched_contender(tables())), 24);
  EXPECT_EQ(oscillating(heavy, contender("declared rigid")), 0);
}

// README's geometric means over the limit, above 40 urad, are of the whole grid; here from its middle.
TEST(FlexibleStudy, FindsTheDefaultInTheMiddleOfTheGridNoWorseThanTheReadmeSaysOfAllOfIt) {
  std::vector<FlexibleCell> middle;
  for (const FlexibleCell& cell : flexible_grid())
    if (cell.damping_ratio == 0.03 && cell.stiffness_scale == 1.0 &&
        (cell.temperature_C == -10.0 || cell.temperature_C == 20.0))
      middle.push_back(cell);
  const auto rows = run_flexible(middle, {contender("daemon"), contender("PID")}, [](std::size_t) {});
  std::map<double, std::pair<double, double>> logarithms;
  std::map<double, int> cells;
  for (const FlexibleRow& row : rows) {
    logarithms[row.cell.step_rad].first += std::log(row.results[0].link_counted_ratio);
    logarithms[row.cell.step_rad].second += std::log(row.results[1].link_counted_ratio);
    ++cells[row.cell.step_rad];
  }
  const std::map<double, double> readme = {{0.001, 12.6}, {0.01, 1.77}, {0.1, 1.07}, {1.0, 1.05}};
  for (const auto& [step_rad, of_readme] : readme) {
    const double daemon = std::exp(logarithms[step_rad].first / cells[step_rad]);
    EXPECT_LT(daemon, 1.25 * of_readme) << step_rad;
    EXPECT_LT(daemon, std::exp(logarithms[step_rad].second / cells[step_rad])) << step_rad << ", PID";
  }
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
