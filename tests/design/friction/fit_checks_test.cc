// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/fit_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

constexpr double kLow_C = 1.0;
constexpr double kHigh_C = 500.0;

FitProblem source_problem() {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv");
  return {fit_targets(data), friction_metric(FitWeighting::kTorque, data.motor_speeds_rpm), true};
}

ExponentialFit some_law() {
  ExponentialFit law;
  law.reference_C = -10.0;
  law.decay_C = 12.0;
  law.p0 << 3.0, 1.4, 1e-3;
  law.p1 << 5.0, 4.0, 9e-3;
  return law;
}

TEST(FitChecks, FindNoOutlierInTheSourcesCatalogueNorInTheLawItself) {
  EXPECT_TRUE(find_outliers(source_problem(), kLow_C, kHigh_C).empty());
  FitProblem exact = source_problem();
  exact.targets.parameters = predict(some_law(), exact.targets.temperature_C);
  EXPECT_TRUE(find_outliers(exact, kLow_C, kHigh_C).empty());
}

// A catalogue value that is ten times too large changes the intercept and the slope of its line over speed.
TEST(FitChecks, FindTheTemperatureOfAnyCellThatIsTenTimesTooLarge) {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv");
  const std::vector<double>& speeds = data.motor_speeds_rpm;
  double mean = 0.0;
  double squares = 0.0;
  for (const double speed : speeds) mean += speed / 4.0;
  for (const double speed : speeds) squares += (speed - mean) * (speed - mean);
  for (Eigen::Index row = 0; row < 21; ++row) {
    for (const double speed : speeds) {
      FitProblem problem = source_problem();
      const double excess =
          9.0 * (problem.targets.parameters(row, 1) + speed * problem.targets.parameters(row, 2));
      const double slope = excess * (speed - mean) / squares;
      const double intercept = excess / 4.0 - slope * mean;
      problem.targets.parameters.row(row) += Eigen::RowVector3d(intercept, intercept, slope);
      const auto outliers = find_outliers(problem, kLow_C, kHigh_C);
      ASSERT_EQ(outliers.size(), 1U) << row << " at " << speed;
      EXPECT_EQ(outliers[0].row, row) << speed;
      EXPECT_GT(outliers[0].cost, kOutlierFactor * outliers[0].cost_without);
    }
  }
}

TEST(FitChecks, FindTwoTemperaturesThatHideEachOther) {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv");
  const double mean = 1750.0;
  double squares = 0.0;
  for (const double speed : data.motor_speeds_rpm) squares += (speed - mean) * (speed - mean);
  // The value at the second of four speeds is ten times too large.
  const double speed = data.motor_speeds_rpm[1];
  int pairs = 0;
  for (Eigen::Index first = 0; first < 21; first += 3)
    for (Eigen::Index second = first + 1; second < 21; second += 3, ++pairs) {
      FitProblem problem = source_problem();
      for (const Eigen::Index row : {first, second}) {
        const double excess =
            9.0 * (problem.targets.parameters(row, 1) + speed * problem.targets.parameters(row, 2));
        const double slope = excess * (speed - mean) / squares;
        const double intercept = excess / 4.0 - slope * mean;
        problem.targets.parameters.row(row) += Eigen::RowVector3d(intercept, intercept, slope);
      }
      std::vector<Eigen::Index> rows;
      for (const Outlier& outlier : find_outliers(problem, kLow_C, kHigh_C)) rows.push_back(outlier.row);
      std::sort(rows.begin(), rows.end());
      EXPECT_EQ(rows, (std::vector<Eigen::Index>{first, second}));
    }
  EXPECT_GT(pairs, 20);
}

TEST(FitChecks, TellWhetherFrictionGrowsWithTemperature) {
  FitProblem problem = source_problem();
  EXPECT_LT(growth_with_temperature(problem), 0.7);
  problem.targets.parameters = problem.targets.parameters.colwise().reverse().eval();
  EXPECT_GT(growth_with_temperature(problem), 1.4);
  problem.targets.parameters.rowwise() = Eigen::RowVector3d(3.0, 1.4, 1e-3);
  EXPECT_NEAR(growth_with_temperature(problem), 1.0, 1e-12);
}

}  // namespace
}  // namespace strainwave
