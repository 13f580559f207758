#include "design/friction_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/input_error.h"

namespace strainwave {
namespace {

constexpr StribeckShape kShape{0.042, 2.0};
constexpr FrictionParameters kTrue{2.5, 1.4, 0.8};
const std::vector<double> kSpeeds{0.01, 0.02, 0.04, 0.08, 0.16, 0.31, 0.61, 1.2, 2.4};

std::vector<SteadyPoint> points(double noise_Nm, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<SteadyPoint> result;
  for (const double speed : kSpeeds)
    result.push_back(
        {20.0, speed, stribeck_friction_Nm(kTrue, kShape, speed) + noise_Nm * normal(random), 0.0});
  return result;
}

TEST(FrictionRegression, RecoversWhatMadeThePoints) {
  std::mt19937_64 random(1);
  const FrictionRegression fit = regress_friction(points(0.0, random), kShape, 0.95);
  EXPECT_NEAR(fit.static_Nm.value, kTrue.static_Nm, 1e-9);
  EXPECT_NEAR(fit.coulomb_Nm.value, kTrue.coulomb_Nm, 1e-9);
  EXPECT_NEAR(fit.viscous_Nms_rad.value, kTrue.viscous_Nms_rad, 1e-9);
  EXPECT_LT(fit.static_Nm.half_width, 1e-6);
  EXPECT_EQ(fit.degrees_of_freedom, 6);
}

/// How often the interval holds the truth.
struct Coverage {
  int static_hits = 0, coulomb_hits = 0, viscous_hits = 0;
};
bool holds(const Interval& interval, double truth) {
  return std::abs(interval.value - truth) <= interval.half_width;
}

TEST(FrictionRegression, ItsIntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kTrials = 4000;
  for (const double confidence : {0.5, 0.95}) {
    std::mt19937_64 random(20240917);
    Coverage hits;
    for (int trial = 0; trial < kTrials; ++trial) {
      const FrictionRegression fit = regress_friction(points(0.05, random), kShape, confidence);
      hits.static_hits += holds(fit.static_Nm, kTrue.static_Nm) ? 1 : 0;
      hits.coulomb_hits += holds(fit.coulomb_Nm, kTrue.coulomb_Nm) ? 1 : 0;
      hits.viscous_hits += holds(fit.viscous_Nms_rad, kTrue.viscous_Nms_rad) ? 1 : 0;
    }
    // Four standard deviations of a binomial count.
    const double tolerance = 4.0 * std::sqrt(confidence * (1.0 - confidence) / kTrials);
    for (const int count : {hits.static_hits, hits.coulomb_hits, hits.viscous_hits})
      EXPECT_NEAR(static_cast<double>(count) / kTrials, confidence, tolerance);
  }
}

TEST(FrictionRegression, RefusesSpeedsThatDoNotTellTheParametersApart) {
  std::vector<SteadyPoint> fast;
  for (const double speed : {1.0, 2.0, 3.0, 4.0, 5.0}) fast.push_back({20.0, speed, 1.0 + speed, 0.0});
  EXPECT_THROW(regress_friction(fast, kShape, 0.95), InputError);
  std::mt19937_64 random(1);
  auto few = points(0.0, random);
  few.resize(3);
  EXPECT_THROW(regress_friction(few, kShape, 0.95), InputError);
  const std::vector<SteadyPoint> same(6, SteadyPoint{20.0, 0.05, 2.0, 0.0});
  EXPECT_THROW(regress_friction(same, kShape, 0.95), InputError);
}

TEST(FrictionRegression, GroupsPointsByTemperature) {
  const auto groups =
      group_by_temperature({{25.1, 1, 1, 0}, {-9.0, 1, 1, 0}, {24.0, 1, 1, 0}, {-10.0, 1, 1, 0}}, 3.0);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].size(), 2U);
  EXPECT_EQ(groups[0][0].temperature_C, -10.0);
  EXPECT_EQ(groups[1][1].temperature_C, 25.1);
}

}  // namespace
}  // namespace strainwave
