// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/ordered_memberships.h"

#include <gtest/gtest.h>

#include "design/friction/catalogue.h"
#include "design/friction/descending_curve.h"
#include "design/friction/friction_metric.h"

namespace strainwave {
namespace {

FitProblem shipped_problem(FitWeighting weighting) {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv");
  return {fit_targets(data), friction_metric(weighting, data.motor_speeds_rpm), true};
}

FuzzyFit fit(const FitProblem& problem, int rules) {
  return fit_ordered_memberships(problem, rules, {}, -10.0, 40.0, 1);
}

TEST(OrderedMemberships, NeverRiseAndFitTheCatalogueWithEveryNumberOfRules) {
  double before = 1.0;
  for (int rules = 3; rules <= 8; ++rules) {
    const FuzzyFit found = fit(shipped_problem(FitWeighting::kTorque), rules);
    EXPECT_LT(worst_rise(found, -10.0, 40.0).share, 1e-6) << rules;
    EXPECT_LT(found.cost, before) << rules << ": a rule more must not fit worse";
    before = found.cost;
  }
  EXPECT_LT(before, 0.05) << "eight rules";
}

TEST(OrderedMemberships, FitTheWeightingOfZhao2006) {
  EXPECT_LT(fit(shipped_problem(FitWeighting::kSource), 5).cost, 0.0125);
}

}  // namespace
}  // namespace strainwave
