#include "sim/studies/temperature_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/studies/temperature_report.h"

namespace strainwave {
namespace {

const FlexibleTables& tables() {
  static const FlexibleTables read =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  return read;
}

const std::vector<FrictionWay>& ways() {
  static const std::vector<FrictionWay> all = friction_ways(tables());
  return all;
}

const std::vector<TemperatureRow>& rows() {
  static const std::vector<TemperatureRow> all = run_temperatures(ways(), sensor_faults());
  return all;
}

/// The table of the page whose heading is `heading`: per row its numbers by the first field. "a / b" counts as a.
std::map<std::string, std::vector<double>> page_table(const std::string& heading) {
  std::ifstream page(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "docs" / "why-temperature.md");
  std::map<std::string, std::vector<double>> table;
  std::string line;
  while (std::getline(page, line) && line != heading) {
  }
  while (std::getline(page, line) && (line.empty() || line[0] != '|')) {
  }
  std::getline(page, line);  // the rule below the header
  while (std::getline(page, line) && !line.empty() && line[0] == '|') {
    std::istringstream fields(line.substr(2));
    std::string name;
    std::getline(fields, name, '|');
    name.erase(name.find_last_not_of(' ') + 1);
    for (std::string field; std::getline(fields, field, '|');) table[name].push_back(std::stod(field));
  }
  return table;
}

TEST(TemperatureStudy, FindsTheReductionsThatItsPageNames) {
  const auto said = page_table("### How far below uncompensated");
  ASSERT_EQ(said.size(), ways().size());
  for (const auto& [way, percents] : said) {
    ASSERT_EQ(percents.size(), kStudyTemperatures_C.size());
    for (std::size_t i = 0; i < percents.size(); ++i)
      EXPECT_NEAR(100.0 * (1.0 - rms_over_none(rows(), way, kStudyTemperatures_C[i])), percents[i], 2.0)
          << way << ", " << kStudyTemperatures_C[i] << " degC";
  }
}

TEST(TemperatureStudy, FindsTheMotionsOfTheProductAndItsRivalInTheColdAsItsPageDoes) {
  const auto said = page_table("### In the cold, motion by motion");
  for (const std::string way : {"disturbance observer", "scheduled and integral", "none"}) {
    std::vector<double> found;
    for (const TemperatureRow& row : rows())
      if (row.way == way && row.sensor == "right" && row.temperature_C == kColdest_C)
        found.push_back(1e6 * row.error.rms_rad);
    ASSERT_EQ(said.at(way).size(), found.size()) << way;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / said.at(way)[i], 1.0, 0.15) << way;
  }
}

TEST(TemperatureStudy, IsAtEveryTemperatureEightyFivePercentBelowUncompensated) {
  for (const double temperature_C : kStudyTemperatures_C)
    EXPECT_LT(rms_over_none(rows(), ways().back().name, temperature_C), 0.15) << temperature_C;
}

TEST(TemperatureStudy, FindsOfAWrongSensorWhatItsPageSays) {
  const auto said = page_table("### A sensor that is wrong");
  const auto motions = study_motions();
  for (const SensorFault& sensor : sensor_faults()) {
    ASSERT_EQ(said.at(sensor.name).size(), kStudyTemperatures_C.size());
    for (std::size_t i = 0; i < kStudyTemperatures_C.size(); ++i) {
      const double ratio = rms_over_none(rows(), ways().back().name, kStudyTemperatures_C[i], sensor.name);
      EXPECT_NEAR(100.0 * (1.0 - ratio), said.at(sensor.name)[i], 3.0)
          << sensor.name << ", " << kStudyTemperatures_C[i] << " degC";
    }
  }
}

TEST(TemperatureStudy, FindsOfTheFirstMoveAndTheHundredthWhatItsPageSays) {
  const auto said = page_table("### The first move and the hundredth");
  for (const std::size_t way : {std::size_t{3}, ways().size() - 1}) {
    const auto moves = run_hundred_moves(ways()[way], kHundredMoves_rad, kColdest_C);
    const std::vector<double>& urad = said.at(ways()[way].name);
    EXPECT_NEAR(1e6 * moves.front().rms_rad / urad.front(), 1.0, 0.15) << ways()[way].name;
    EXPECT_NEAR(1e6 * moves.back().rms_rad / urad.back(), 1.0, 0.25) << ways()[way].name;
  }
}

TEST(TemperatureStudy, MovesInTheColdThreeTimesBetterThanWhatKnowsNoTemperatureFromTheFirstMoveOn) {
  const double product_rad = run_hundred_moves(ways().back(), kHundredMoves_rad, kColdest_C).front().rms_rad;
  for (const FrictionWay& way : ways()) {
    if (way.name.rfind("scheduled", 0) == 0) continue;
    const double rms_rad = run_hundred_moves(way, kHundredMoves_rad, kColdest_C).front().rms_rad;
    EXPECT_GT(rms_rad, 3.0 * product_rad) << way.name;
  }
}

// Nothing is left to know then: what remains is counts, delay and the gear's swing.
TEST(TemperatureStudy, IsInEveryMotionEightyFivePercentBelowUncompensatedWhereTheTableHasTheJointsFriction) {
  const auto said = page_table("### What is left where friction is known");
  const TextTable found = friction_known_table(run_friction_known(ways(), study_table(tables())));
  ASSERT_EQ(found.rows.size(), said.size());
  for (const std::vector<std::string>& row : found.rows)
    for (std::size_t i = 0; i < kStudyTemperatures_C.size(); ++i) {
      const double percent = std::stod(row[i + 1]);
      EXPECT_GT(percent, 85.0) << row[0] << ", " << kStudyTemperatures_C[i] << " degC";
      EXPECT_NEAR(percent, said.at(row[0])[i], 1.0) << row[0] << ", " << kStudyTemperatures_C[i] << " degC";
    }
}

// Nor with a sensor that is wrong or missing; ways that know less of friction may.
TEST(TemperatureStudy, NeitherFallsBackNorIsSwitchedOffWhereTheTemperatureIsKnown) {
  for (const TemperatureRow& row : rows()) {
    EXPECT_NE(row.monitor, MonitorState::kFaultDue) << row.way << ", " << row.sensor << ", " << row.motion;
    if (row.way.rfind("scheduled", 0) != 0) continue;
    EXPECT_EQ(row.monitor, MonitorState::kWatching) << row.way << ", " << row.sensor << ", " << row.motion;
  }
}

// On a joint without friction nothing is left of the path but what reading and delay leave: all ways follow the same path, and the
// stream is sent as much earlier as it is late.
TEST(TemperatureStudy, FollowsThePathWithoutALagWhereThereIsNoFriction) {
  JointPlantConfig plant = temperature_plant();
  plant.joint.friction.asymptote = plant.joint.friction.amplitude = {0.0, 0.0, 0.0};
  const FrictionWay& none = ways().front();
  for (const PathMotion& motion : study_motions()) {
    const PathRun run =
        run_path(plant, none, motion.path, sensor_faults().front(), 20.0, {motion.path.end_s()});
    EXPECT_LT(run.stretches.front().peak_rad, 4e-4) << motion.name;
  }
}

}  // namespace
}  // namespace strainwave
