// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/fuzzy_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

using Limits = std::numeric_limits<double>;

/// Doubles of every magnitude and both signs, and both infinities.
std::vector<double> whole_range() {
  std::vector<double> values{
      0.0, -0.0, Limits::infinity(), Limits::max(), 1e308, Limits::denorm_min(), Limits::min()};
  for (int exponent = -320; exponent <= 308; exponent += 4) values.push_back(std::pow(10.0, exponent));
  for (double value = 0.0; value < 60.0; value += 0.37) values.push_back(value);
  const std::size_t count = values.size();
  for (std::size_t i = 0; i < count; ++i) values.push_back(-values[i]);
  return values;
}

void expect_partition(const TemperatureWeights& weights, double temperature_C) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i) {
    EXPECT_GE(weights.weight[i], 0.0) << temperature_C;
    EXPECT_LE(weights.weight[i], 1.0) << temperature_C;
    sum += weights.weight[i];
  }
  EXPECT_NEAR(sum, 1.0, 1e-14) << temperature_C;
}

TEST(FuzzyFriction, WeightsSumToOneOverTheWholeRangeOfDoublesForRandomRulesHoweverNarrow) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> center(-50.0, 80.0);
  std::uniform_real_distribution<double> exponent(-3.0, 3.0);
  std::uniform_int_distribution<int> count(1, kMaxTemperatureRules);
  for (int trial = 0; trial < 200; ++trial) {
    FuzzyFriction friction;
    friction.rule_count = count(random);
    friction.temperature_min_C = -20.0;
    friction.temperature_max_C = 60.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(friction.rule_count); ++i)
      friction.rules[i] = {center(random), std::pow(10.0, exponent(random)), {}};
    for (const double temperature_C : whole_range())
      expect_partition(friction.weights(temperature_C), temperature_C);
  }
}

TEST(FuzzyFriction, OutsideTheTableTheTemperatureIsThatOfItsEdge) {
  const FuzzyFriction friction = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json").friction;
  const TemperatureWeights edge = friction.weights(friction.temperature_max_C);
  const TemperatureWeights beyond = friction.weights(1e308);
  EXPECT_EQ(edge.weight, beyond.weight);
}

TEST(FuzzyFriction, TheZeroVelocityWeightIsEvenFallsWithSpeedAndStaysBetweenZeroAndOne) {
  const FuzzyFriction friction = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json").friction;
  for (const double velocity_rad_s : whole_range()) {
    const double here = friction.velocity.zero_weight(velocity_rad_s);
    EXPECT_GE(here, 0.0) << velocity_rad_s;
    EXPECT_LE(here, 1.0) << velocity_rad_s;
    EXPECT_EQ(here, friction.velocity.zero_weight(-velocity_rad_s)) << velocity_rad_s;
  }
  double last = 1.0;
  for (double speed_rad_s = 0.0; speed_rad_s < 2.0; speed_rad_s += 0.003) {
    EXPECT_LE(friction.velocity.zero_weight(speed_rad_s), last) << speed_rad_s;
    last = friction.velocity.zero_weight(speed_rad_s);
  }
}

}  // namespace
}  // namespace strainwave
