// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_regression.h"

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
  const FrictionRegression fit = regress_friction(points(0.0, random), kShape, 0.95, 0.0);
  EXPECT_NEAR(fit.static_Nm.value, kTrue.static_Nm, 1e-9);
  EXPECT_NEAR(fit.coulomb_Nm.value, kTrue.coulomb_Nm, 1e-9);
  EXPECT_NEAR(fit.viscous_Nms_rad.value, kTrue.viscous_Nms_rad, 1e-9);
  EXPECT_LT(fit.static_Nm.half_width, 1e-6);
  EXPECT_EQ(fit.degrees_of_freedom, 6);
}

/// Number of intervals that contain the true value.
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
      const FrictionRegression fit = regress_friction(points(0.05, random), kShape, confidence, 0.0);
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

/// Returns for how many of 200 joints the intervals contain the true friction. Each joint has its own torque constant, with this relative standard
/// deviation.
Coverage of_other_joints(double torque_deviation, double torque_uncertainty) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  Coverage hits;
  for (int joint = 0; joint < 200; ++joint) {
    const double factor = 1.0 + torque_deviation * normal(random);
    std::vector<SteadyPoint> seen;
    for (const double speed : kSpeeds)
      seen.push_back(
          {20.0, speed, factor * stribeck_friction_Nm(kTrue, kShape, speed) + 0.005 * normal(random), 0.0});
    const FrictionRegression fit = regress_friction(seen, kShape, 0.95, torque_uncertainty);
    hits.static_hits += holds(fit.static_Nm, kTrue.static_Nm) ? 1 : 0;
    hits.coulomb_hits += holds(fit.coulomb_Nm, kTrue.coulomb_Nm) ? 1 : 0;
    hits.viscous_hits += holds(fit.viscous_Nms_rad, kTrue.viscous_Nms_rad) ? 1 : 0;
  }
  std::printf("of 200 joints: static %d, Coulomb %d, viscous %d\n", hits.static_hits, hits.coulomb_hits,
              hits.viscous_hits);
  return hits;
}

TEST(FrictionRegression, ATorqueConstantThatIsOffWidensItsIntervals) {
  const Coverage hits = of_other_joints(0.02, 0.02);
  for (const int held : {hits.static_hits, hits.coulomb_hits, hits.viscous_hits}) EXPECT_GE(held, 180);
  EXPECT_LT(of_other_joints(0.02, 0.002).coulomb_hits, 150) << "the test would show nothing";
}

/// Share of intervals that contain the true static friction. A single slow point with 1 % torque error determines it. The other points have small
/// errors, so that their residuals do not reveal that error.
double static_coverage(double torque_uncertainty, std::uint64_t seed) {
  constexpr int kTrials = 500;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  int hits = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<SteadyPoint> slow_ones_left_out;
    for (const double speed : {0.06, 0.15, 0.23, 0.35, 0.55, 0.85, 1.3, 2.1, 3.2}) {
      const double error = speed < 0.1 ? 0.01 * normal(random) : 1e-4 * normal(random);
      slow_ones_left_out.push_back(
          {20.0, speed, stribeck_friction_Nm(kTrue, kShape, speed) * (1.0 + error), 0.0});
    }
    const FrictionRegression fit = regress_friction(slow_ones_left_out, kShape, 0.95, torque_uncertainty);
    hits += holds(fit.static_Nm, kTrue.static_Nm) ? 1 : 0;
  }
  return static_cast<double>(hits) / kTrials;
}

TEST(FrictionRegression, ItsIntervalOfStaticFrictionCountsWhatASingleSlowPointMayBeOff) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    EXPECT_GE(static_coverage(0.01, seed), 0.95 - 4.0 * std::sqrt(0.95 * 0.05 / 500)) << seed;
    EXPECT_LT(static_coverage(0.0, seed), 0.5) << "the test would show nothing, seed " << seed;
  }
}

TEST(FrictionRegression, ARippleOfTheSpeedIsWorthTheMeanOfTheBentCurve) {
  constexpr double kDeviation_rad_s = 0.004;
  for (const double speed : {0.02, 0.05, 0.06, 0.08, 0.5}) {
    const auto friction_Nm = [&](double off) { return stribeck_friction_Nm(kTrue, kShape, speed + off); };
    const double mean_Nm = 0.5 * (friction_Nm(kDeviation_rad_s) + friction_Nm(-kDeviation_rad_s));
    const SteadyPoint point{20.0, speed, friction_Nm(0.0), 0.0, kDeviation_rad_s};
    EXPECT_NEAR(ripple_Nm(kShape, kTrue.static_Nm - kTrue.coulomb_Nm, point),
                std::abs(mean_Nm - friction_Nm(0.0)), 2e-4)
        << speed;
  }
  EXPECT_EQ(ripple_Nm(kShape, 1.1, SteadyPoint{20.0, 0.05, 2.0, 0.0}), 0.0);
}

TEST(FrictionRegression, RefusesSpeedsThatDoNotTellTheParametersApart) {
  std::vector<SteadyPoint> fast;
  for (const double speed : {1.0, 2.0, 3.0, 4.0, 5.0}) fast.push_back({20.0, speed, 1.0 + speed, 0.0});
  EXPECT_THROW(regress_friction(fast, kShape, 0.95, 0.01), InputError);
  std::mt19937_64 random(1);
  auto few = points(0.0, random);
  few.resize(3);
  EXPECT_THROW(regress_friction(few, kShape, 0.95, 0.01), InputError);
  const std::vector<SteadyPoint> same(6, SteadyPoint{20.0, 0.05, 2.0, 0.0});
  EXPECT_THROW(regress_friction(same, kShape, 0.95, 0.01), InputError);
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
