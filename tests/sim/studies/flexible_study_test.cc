// Above 300 lines: what the pages say of one grid, with the helpers that its tests share.
#include "sim/studies/flexible_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/parallel.h"
#include "control/link_model.h"
#include "control/scheduled_controller.h"
#include "sim/studies/link_limit.h"
#include "tests/sim/studies/printed_table.h"

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

/// `count` numbers of the page after `words`, whatever stands between them.
std::vector<int> page_numbers(const std::string& words, int count) {
  std::ifstream page(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "docs" / "flexible-joint.md");
  for (std::string line; std::getline(page, line);) {
    const std::size_t found = line.find(words);
    if (found == std::string::npos) continue;
    std::istringstream rest(
        std::regex_replace(line.substr(found + words.size()), std::regex("[^0-9]+"), " "));
    std::vector<int> numbers(static_cast<std::size_t>(count));
    for (int& number : numbers) rest >> number;
    return numbers;
  }
  throw std::invalid_argument(words);
}

// That the study sees an oscillation where there is one: it is what the first version of this project did.
TEST(FlexibleStudy, FindsTheOscillationsOfEveryPartOnWithoutTheMonitorOnHeavyLinks) {
  std::map<double, std::vector<FlexibleCell>> of_link;
  for (const FlexibleCell& cell : first_grid()) of_link[cell.link_inertia_kgm2].push_back(cell);
  const std::vector<int> said = page_numbers("no monitor oscillates in ", 3);
  ASSERT_EQ(of_link.size(), said.size());
  auto cells_said = said.begin();
  for (const auto& [link_inertia_kgm2, cells] : of_link)
    EXPECT_NEAR(oscillating(cells, unwatched_contender(tables())), *cells_said++, 1) << link_inertia_kgm2;
  EXPECT_EQ(oscillating(of_link.rbegin()->second, contender("declared rigid")), 0);
}

/// The number in column `column` of the page's row of contender `name`, from 1.
int page_number(const std::string& name, std::size_t column) {
  return std::stoi(printed_row("docs/flexible-joint.md", name).at(column - 1));
}

/// What no ratio to the limit tells, of one contender on the whole grid.
struct GridBehaviour {
  int fallen_back = 0, switched_off = 0;
  int still_moving = 0;  ///< cells whose link moves by more than kOscillation_rad over the last quarter
  std::map<double, double> overshoot_mrad;  ///< the largest, by step
};

GridBehaviour behaviour_on_the_grid(const Contender& judged) {
  const std::vector<FlexibleCell> grid = flexible_grid();
  struct Cell {
    MonitorState monitor = MonitorState::kWatching;
    double swing_rad = 0.0, overshoot_mrad = 0.0;
  };
  std::vector<Cell> cells(grid.size());
  run_in_parallel(grid.size(), [&](std::size_t i) {
    const ClosedLoopResult run = run_cell(grid[i], judged);
    cells[i].monitor = run.monitor;
    double low = 1e300, high = -1e300;
    for (const TracePoint& point : run.trace) {
      cells[i].overshoot_mrad =
          std::max(cells[i].overshoot_mrad, 1e3 * (point.link_position_rad - grid[i].step_rad));
      if (point.time_s < 0.75 * grid[i].duration_s) continue;
      low = std::min(low, point.link_position_rad);
      high = std::max(high, point.link_position_rad);
    }
    cells[i].swing_rad = high - low;
  });
  GridBehaviour result;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    result.fallen_back += cells[i].monitor == MonitorState::kFallenBack ? 1 : 0;
    result.switched_off += cells[i].monitor == MonitorState::kFaultDue ? 1 : 0;
    result.still_moving += cells[i].swing_rad > kOscillation_rad ? 1 : 0;
    double& largest = result.overshoot_mrad[grid[i].step_rad];
    largest = std::max(largest, cells[i].overshoot_mrad);
  }
  return result;
}

std::string readme() {
  std::ifstream file(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "README.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string words = text.str();
  std::replace(words.begin(), words.end(), '\n', ' ');
  return words;
}

/// `count` numbers of README after `words`.
std::vector<double> readme_numbers(const std::string& words, int count) {
  const std::string text = readme();
  const std::size_t found = text.find(words);
  if (found == std::string::npos) throw std::invalid_argument(words);
  std::istringstream rest(text.substr(found + words.size()));
  std::vector<double> numbers(static_cast<std::size_t>(count));
  for (double& number : numbers) {
    if (!(rest >> number)) throw std::invalid_argument(words);
    rest.ignore(1);  // the comma
  }
  return numbers;
}

// Which side of a limit a cell falls on may differ between compilers.
void expect_behaviour(const std::string& name, const std::string& overshoot_after,
                      const std::string& moving_after) {
  const GridBehaviour found = behaviour_on_the_grid(contender(name));
  EXPECT_NEAR(found.still_moving, readme_numbers(moving_after, 1).front(), 3) << name;
  if (overshoot_after.empty()) return;
  EXPECT_NEAR(found.fallen_back, page_number(name, 4), 3) << name;
  EXPECT_NEAR(found.switched_off, page_number(name, 5), 1) << name;
  const std::vector<double> said_mrad = readme_numbers(overshoot_after, 4);
  ASSERT_EQ(found.overshoot_mrad.size(), said_mrad.size());
  auto said = said_mrad.begin();
  for (const auto& [step_rad, overshoot_mrad] : found.overshoot_mrad) {
    EXPECT_NEAR(overshoot_mrad / *said, 1.0, 0.1) << name << ", " << step_rad << " rad";
    ++said;
  }
}

TEST(FlexibleStudy, FindsTheFallbacksOvershootsAndSlowSwingsThatThePagesTellOf) {
  expect_behaviour("daemon", "largest overshoot without the model is ", "an oscillation (without the model ");
  expect_behaviour("daemon told of its spring", "at the four steps (told of its spring ",
                   ", told of its spring ");
  expect_behaviour("PID", "", "come to rest: in ");
}

/// A cell whose joint has the friction that the table says.
FlexibleCell with_friction_known(FlexibleCell cell) {
  const GainTable& table = FlexibleTables::nearest(tables().c4, 0.089 + cell.link_inertia_kgm2);
  for (JointPlantConfig* plant : {&cell.nominal, &cell.plant})
    *plant = with_declared_friction(*plant, table, cell.temperature_C);
  return cell;
}

// Link side, motor's encoder, everything known; links of up to three times the motor's inertia, 3 % damping, every stiffness.
TEST(FlexibleStudy, ReachesTheLimitOfTheLinkWhereFrictionIsKnown) {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : flexible_grid())
    if (cell.link_inertia_kgm2 < 0.5 && cell.damping_ratio == 0.03)
      cells.push_back(with_friction_known(cell));
  std::map<double, std::vector<double>> over_limit;
  std::map<double, std::vector<double>> overshoot_rad;
  std::vector<double> over_least_time;  // of a milliradian
  for (const FlexibleRow& row :
       run_flexible(cells, {contender("daemon told of its spring")}, [](std::size_t) {})) {
    const FlexibleResult& result = row.results.front();
    over_limit[row.cell.step_rad].push_back(result.link_counted_ratio);
    overshoot_rad[row.cell.step_rad].push_back(result.overshoot_rad);
    EXPECT_EQ(result.monitor, MonitorState::kWatching);
    EXPECT_GT(result.settling_time_s, 0.0);
    if (row.cell.step_rad != 0.001) continue;
    const LinkLimitConfig motion =
        link_limit_config(row.cell.plant, row.cell.temperature_C, row.cell.step_rad);
    over_least_time.push_back(result.settling_time_s / least_settling_time_s(motion, kCountedError_rad));
  }
  std::sort(over_least_time.begin(), over_least_time.end());
  const double median_time = over_least_time[over_least_time.size() / 2];
  const double late_time = over_least_time[over_least_time.size() * 9 / 10];
  std::cout << "a milliradian settles in " << median_time << " times the least time, " << late_time
            << " in nine cells of ten\n";
  EXPECT_LE(median_time, 1.2);
  EXPECT_LE(late_time, 3.3);
  struct Goal {
    double step_rad, median, worst, overshoot_median_rad, overshoot_worst_rad;
  };
  for (const Goal& goal : {Goal{0.001, 1.15, 1.4, 25e-6, 60e-6}, Goal{0.01, 1.35, 1.8, 30e-6, 160e-6},
                           Goal{0.1, 1.15, 1.35, 35e-6, 60e-6}, Goal{1.0, 1.08, 1.2, 40e-6, 60e-6}}) {
    std::vector<double>& ratios = over_limit.at(goal.step_rad);
    std::vector<double>& overshoots = overshoot_rad.at(goal.step_rad);
    std::sort(ratios.begin(), ratios.end());
    std::sort(overshoots.begin(), overshoots.end());
    EXPECT_LE(ratios[ratios.size() / 2], goal.median) << goal.step_rad;
    EXPECT_LE(ratios.back(), goal.worst) << goal.step_rad;
    EXPECT_LE(overshoots[overshoots.size() / 2], goal.overshoot_median_rad) << goal.step_rad;
    EXPECT_LE(overshoots.back(), goal.overshoot_worst_rad) << goal.step_rad;
  }
}

/// How far friction that is not what the table says takes the motor before a torque can answer: until its reading differs by a count for
/// certain, and a period and the delay longer. Whatever the torque is, as long as the motor slides one way.
double unseen_rad(const FlexibleCell& cell) {
  const Transmission& gear = *cell.plant.effects.transmission;
  const FlexibleCell known = with_friction_known(cell);
  const double off_Nm = std::abs(known.plant.joint.friction.at(cell.temperature_C).coulomb_Nm -
                                 cell.plant.joint.friction.at(cell.temperature_C).coulomb_Nm);
  const LinkModel apart{
      cell.plant.joint.inertia_kgm2, gear.link_inertia_kgm2, gear.spring, gear.damping_Nms_rad, {}};
  const int late_periods = 1 + static_cast<int>(std::lround(cell.plant.delay.periods));
  LinkState state;
  int answered = 0;
  for (int k = 0; k < 1000 && answered < late_periods; ++k) {
    if (state.motor_position_rad >= cell.plant.encoder.resolution_rad()) ++answered;
    state = apart.advance(state, off_Nm, cell.plant.period_s).end;
  }
  return state.motor_position_rad;
}

struct Spread {
  explicit Spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    median_urad = 1e6 * values[values.size() / 2];
    worst_urad = 1e6 * values.back();
  }
  double median_urad, worst_urad;
};

// What a milliradian's overshoot is made of, 3 % damping: the page says it in this order.
TEST(FlexibleStudy, TellsWhatACountAndWhatFrictionLeaveOfAMilliradiansOvershoot) {
  std::vector<FlexibleCell> known, fine, table;
  std::vector<double> of_limit, unseen;
  for (const FlexibleCell& cell : flexible_grid()) {
    if (cell.link_inertia_kgm2 > 0.5 || cell.damping_ratio != 0.03 || cell.step_rad != 0.001) continue;
    table.push_back(cell);
    known.push_back(with_friction_known(cell));
    fine.push_back(known.back());
    for (JointPlantConfig* plant : {&fine.back().nominal, &fine.back().plant})
      plant->encoder.counts_per_joint_revolution *= 100.0;
    unseen.push_back(unseen_rad(cell));
    const LinkLimit limit =
        find_link_limit(link_limit_config(known.back().plant, cell.temperature_C, cell.step_rad));
    of_limit.push_back(*std::max_element(limit.link_position_rad.begin(), limit.link_position_rad.end()) -
                       cell.step_rad);
  }
  const auto overshoot = [&](const std::vector<FlexibleCell>& cells) {
    std::vector<double> all_rad(cells.size());
    run_in_parallel(cells.size(), [&](std::size_t i) {
      for (const TracePoint& point : run_cell(cells[i], contender("daemon told of its spring")).trace)
        all_rad[i] = std::max(all_rad[i], point.link_position_rad - cells[i].step_rad);
    });
    return Spread(all_rad);
  };
  const std::vector<int> said = page_numbers("Of a milliradian's overshoot, in urad: ", 10);
  auto next = said.begin();
  const auto expect = [&](const char* what, const Spread& found) {
    std::cout << what << ": median " << found.median_urad << ", worst " << found.worst_urad << " urad\n";
    EXPECT_NEAR(found.median_urad, *next++, 3.0) << what;
    EXPECT_NEAR(found.worst_urad, *next++, 6.0) << what;
  };
  expect("the limit's own motion", Spread(of_limit));
  expect("friction known, an encoder a hundred times finer", overshoot(fine));
  expect("friction known", overshoot(known));
  expect("the table's friction", overshoot(table));
  expect("friction beside the table's, before a torque can answer", Spread(unseen));
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
      // The motion with the least sum of all is not the one with the least above 40 urad, and its motor turns one way only.
      EXPECT_GE(result.link_counted_ratio, 0.7);
      if (result.oscillates) {
        EXPECT_LT(result.settling_time_s, 0.0) << "what swings has not settled";
      }
    }
}

}  // namespace
}  // namespace strainwave
