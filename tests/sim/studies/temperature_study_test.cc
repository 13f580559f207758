// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/temperature_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

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

/// `percents`: least reduction of the error against no compensation, a mean over the motions, for each of kStudyTemperatures_C.
void expect_at_least(const std::string& sensor, const std::vector<double>& percents) {
  for (std::size_t i = 0; i < kStudyTemperatures_C.size(); ++i)
    EXPECT_GE(100.0 * (1.0 - rms_over_none(rows(), ways().back().name, kStudyTemperatures_C[i], sensor)),
              percents[i])
        << sensor << ", " << kStudyTemperatures_C[i] << " degC";
}

TEST(TemperatureStudy, IsOnItsFirstRunFarBelowUncompensatedWhateverTheSensorSays) {
  expect_at_least("right", {98.5, 98.5, 98.5, 98.5, 98.5, 97.0});
  for (const char* wrong : {"10 degC too high", "10 degC too low", "15 min late"})
    expect_at_least(wrong, {85.0, 90.0, 90.0, 90.0, 90.0, 90.0});
  expect_at_least("missing", {70.0, 85.0, 85.0, 85.0, 85.0, 85.0});
}

TEST(TemperatureStudy, HasLearnedAfterFiveOfTheSameMotions) {
  const std::vector<TemperatureRow> sixth =
      run_temperatures({ways().front(), ways().back()}, sensor_faults(), kLearnedAfter);
  const auto below = [&](const std::string& sensor, double temperature_C) {
    return 100.0 * (1.0 - rms_over_none(sixth, ways().back().name, temperature_C, sensor));
  };
  for (const double temperature_C : kStudyTemperatures_C) {
    EXPECT_GE(below("right", temperature_C), temperature_C < 45.0 ? 98.5 : 97.0) << temperature_C;
    for (const char* wrong : {"10 degC too high", "10 degC too low"})
      EXPECT_GE(below(wrong, temperature_C), 96.0) << wrong << ", " << temperature_C;
    EXPECT_GE(below("missing", temperature_C), temperature_C > -10.0 ? 95.0 : 92.0) << temperature_C;
  }
}

TEST(TemperatureStudy, IsInEveryMotionNinetyPercentBelowUncompensatedWhereTheSensorIsRight) {
  std::map<std::pair<double, std::string>, double> none_rad;
  for (const TemperatureRow& row : rows())
    if (row.way == ways().front().name) none_rad[{row.temperature_C, row.motion}] = row.error.rms_rad;
  for (const TemperatureRow& row : rows())
    if (row.way == ways().back().name && row.sensor == "right") {
      EXPECT_LE(row.error.rms_rad, 0.1 * none_rad.at({row.temperature_C, row.motion}))
          << row.motion << ", " << row.temperature_C << " degC";
    }
}

TEST(TemperatureStudy, TracksATenthOfARadianPerSecondWithinFifteenMicroradians) {
  for (const TemperatureRow& row : rows())
    if (row.way == ways().back().name && row.sensor == "right" && row.temperature_C == 20.0 &&
        row.motion == "track 0.1 rad/s") {
      EXPECT_LE(row.error.rms_rad, 15e-6);
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

TEST(TemperatureStudy, NoWayIsSwitchedOff) {
  for (const TemperatureRow& row : rows())
    EXPECT_FALSE(row.switched_off) << row.way << ", " << row.sensor << ", " << row.motion;
}

// Without friction only the errors of reading and delay remain. All ways follow the same path, and the stream is sent earlier by its
// delay.
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
