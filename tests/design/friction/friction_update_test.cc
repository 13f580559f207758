// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_update.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/text_file.h"
#include "design/friction/friction_file.h"

namespace strainwave {
namespace {

constexpr StribeckShape kShape{0.0418879, 2.0};
const std::vector<double> kSpeeds{0.01, 0.02, 0.04, 0.08, 0.3, 1.2, 4.0};

const FuzzyFriction& catalogue() {
  static const std::string path = STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006-friction.json";
  static const FuzzyFriction friction = friction_file_from_json(read_text_file(path), path).fuzzy->friction;
  return friction;
}

FuzzyFriction scaled(const FuzzyFriction& friction, double factor) {
  FuzzyFriction result = friction;
  for (TemperatureRule& rule : result.rules) {
    rule.friction.static_Nm *= factor;
    rule.friction.coulomb_Nm *= factor;
    rule.friction.viscous_Nms_rad *= factor;
  }
  return result;
}

double friction_Nm(const FuzzyFriction& friction, double temperature_C, double speed_rad_s) {
  return stribeck_friction_Nm(friction.blend(friction.weights(temperature_C)), kShape, speed_rad_s);
}

std::vector<SteadyPoint> measure(const FuzzyFriction& truth, const std::vector<double>& temperatures_C,
                                 double noise_Nm, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<SteadyPoint> points;
  for (const double T : temperatures_C) {
    for (const double speed : kSpeeds)
      points.push_back({T, speed, friction_Nm(truth, T, speed) + noise_Nm * normal(random), 0.0});
  }
  return points;
}

TEST(FrictionUpdate, WithoutMeasurementsIsThePrior) {
  const FrictionUpdate update(catalogue(), kShape, {}, 0.01, {});
  for (const double T : {-10.0, 5.0, 40.0}) {
    const Interval friction = update.friction_Nm(T, 1.0);
    EXPECT_NEAR(friction.value, friction_Nm(catalogue(), T, 1.0), 1e-6 * friction.value);
    // Coulomb and viscous friction deviate independently, each by about 30 %.
    EXPECT_GT(friction.half_width, 0.2 * friction.value) << T;
    EXPECT_LT(friction.half_width, 0.33 * friction.value) << T;
  }
}

TEST(FrictionUpdate, CarriesACommonDeviationToTemperaturesThatWereNotMeasured) {
  const FuzzyFriction truth = scaled(catalogue(), 1.3);
  std::mt19937_64 random(1);
  const FrictionUpdate update(catalogue(), kShape, measure(truth, {20.0}, 0.01, random), 0.01, {});
  for (const double T : {-10.0, 0.0, 10.0, 20.0, 30.0, 40.0}) {
    const double wanted = friction_Nm(truth, T, 1.2);
    EXPECT_NEAR(update.friction_Nm(T, 1.2).value, wanted, 0.05 * wanted) << T;
  }
  // The update reports larger intervals where it extrapolates.
  const auto relative = [&](double T) {
    const Interval friction = update.friction_Nm(T, 1.2);
    return friction.half_width / friction.value;
  };
  EXPECT_LT(relative(20.0), 0.01);
  EXPECT_GT(relative(-10.0), 5.0 * relative(20.0));
}

TEST(FrictionUpdate, BelievesMeasurementsOverThePriorWhereThereAreMany) {
  // The temperature law has another shape than the catalogue's.
  FuzzyFriction truth = catalogue();
  for (int i = 0; i < truth.rule_count; ++i)
    truth.rules[static_cast<std::size_t>(i)].friction.viscous_Nms_rad *= 1.4 - 0.1 * i;
  std::mt19937_64 random(2);
  const std::vector<double> everywhere{-10.0, -5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0};
  const FrictionUpdate update(catalogue(), kShape, measure(truth, everywhere, 0.001, random), 0.001, {});
  for (const double T : everywhere) {
    const double wanted = friction_Nm(truth, T, 2.0);
    EXPECT_NEAR(update.friction_Nm(T, 2.0).value, wanted, 0.01 * wanted) << T;
  }
}

TEST(FrictionUpdate, ItsDeviationsAreThoseOfItsErrorsWhenThePriorIsTrue) {
  const UpdateWeights weights{0.2, 0.001, 0.01};
  std::mt19937_64 random(20240918);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 1500;
  int hits = 0, all = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    // The breakaway, Coulomb and viscous parameters of the joint each deviate from the catalogue by the common deviation that the prior assumes.
    FuzzyFriction truth = catalogue();
    const double breakaway = normal(random), coulomb = normal(random), viscous = normal(random);
    for (TemperatureRule& rule : truth.rules) {
      FrictionParameters& friction = rule.friction;
      const double excess = friction.static_Nm - friction.coulomb_Nm;
      friction.coulomb_Nm *= 1.0 + weights.common * coulomb;
      friction.static_Nm = friction.coulomb_Nm + excess * (1.0 + weights.common * breakaway);
      friction.viscous_Nms_rad *= 1.0 + weights.common * viscous;
    }
    std::vector<SteadyPoint> points = measure(truth, {0.0, 30.0}, 0.02, random);
    for (SteadyPoint& point : points) point.friction_Nm *= 1.0 + weights.torque_uncertainty * normal(random);
    const FrictionUpdate update(catalogue(), kShape, points, 0.02, weights);
    for (const double T : {-5.0, 15.0, 35.0}) {
      const Interval friction = update.friction_Nm(T, 1.0);
      hits += std::abs(friction.value - friction_Nm(truth, T, 1.0)) <= 1.96 * friction.half_width ? 1 : 0;
      ++all;
    }
  }
  EXPECT_NEAR(static_cast<double>(hits) / all, 0.95, 0.02);
}

TEST(FrictionUpdate, StaysPhysicalWhateverIsMeasured) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<SteadyPoint> points;
    for (int i = 0; i < 20; ++i)
      points.push_back({8.0 * any(random) + 10.0, 0.01 + std::abs(any(random)), any(random), 0.0});
    const FuzzyFriction friction = FrictionUpdate(catalogue(), kShape, points, 0.05, {}).friction();
    for (int i = 0; i < friction.rule_count; ++i) {
      const FrictionParameters& rule = friction.rules[static_cast<std::size_t>(i)].friction;
      EXPECT_GE(rule.coulomb_Nm, 0.0);
      EXPECT_GE(rule.viscous_Nms_rad, 0.0);
      EXPECT_GE(rule.static_Nm, rule.coulomb_Nm);
      if (i == 0) continue;
      const FrictionParameters& colder = friction.rules[static_cast<std::size_t>(i) - 1].friction;
      EXPECT_LE(rule.coulomb_Nm, colder.coulomb_Nm * (1.0 + 1e-9) + 1e-9);
      EXPECT_LE(rule.viscous_Nms_rad, colder.viscous_Nms_rad * (1.0 + 1e-9) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace strainwave
