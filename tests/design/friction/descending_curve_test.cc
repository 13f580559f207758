// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/descending_curve.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

FitProblem source_problem() {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/no_load_torque.csv");
  return {fit_targets(data), friction_metric(FitWeighting::kTorque, data.motor_speeds_rpm), true};
}

// The memberships of the shipped table. A narrow rule lies within a wide one, so that falling rules make a curve that rises.
const Eigen::VectorXd kCenter{{-11.444431634, -11.444431633, 2.303429499, 2.7262053995, 5.025291984}};
const Eigen::VectorXd kWidth{{2.4998621, 10.2533655, 8.4154939, 2.4585181, 8.281497}};

TEST(DescendingCurve, FallsEverywhereWhereTheRulesAloneDoNot) {
  const FitProblem problem = source_problem();
  const FuzzyFit rules = fit_consequents(problem, kCenter, kWidth);
  const CurveRise before = worst_rise(rules, -10.0, 40.0);
  EXPECT_GT(before.share, 0.02) << "the test would show nothing";
  EXPECT_NEAR(before.temperature_C, 6.1, 1.0);
  const FuzzyFit curve = fit_descending_curve(problem, kCenter, kWidth, -10.0, 40.0).value();
  EXPECT_LT(worst_rise(curve, -10.0, 40.0).share, 1e-5);
  EXPECT_GE(curve.cost, rules.cost * (1.0 - 1e-6));
  EXPECT_LT(curve.cost, 4.0 * rules.cost);
}

TEST(DescendingCurve, ChangesNothingThatFallsAlready) {
  const FitProblem problem = source_problem();
  const Eigen::VectorXd center{{-10.0, 0.0, 10.0, 20.0, 35.0}};
  const Eigen::VectorXd width = Eigen::VectorXd::Constant(5, 9.0);
  const FuzzyFit rules = fit_consequents(problem, center, width);
  ASSERT_LT(worst_rise(rules, -10.0, 40.0).share, 1e-9);
  const FuzzyFit curve = fit_descending_curve(problem, center, width, -10.0, 40.0).value();
  EXPECT_TRUE(curve.consequents.isApprox(rules.consequents, 1e-4));
}

TEST(DescendingCurve, HoldsForAnyMembershipsOfNoisyData) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int rising = 0;
  for (int trial = 0; trial < 60; ++trial) {
    FitProblem problem = source_problem();
    for (Eigen::Index k = 0; k < problem.targets.parameters.rows(); ++k)
      problem.targets.parameters.row(k) *= 1.0 + 0.05 * normal(random);
    const Eigen::VectorXd center =
        Eigen::VectorXd::NullaryExpr(5, [&] { return -15.0 + 60.0 * uniform(random); });
    const Eigen::VectorXd width =
        Eigen::VectorXd::NullaryExpr(5, [&] { return 2.0 + 13.0 * uniform(random); });
    rising += worst_rise(fit_consequents(problem, center, width), -10.0, 40.0).share > 0.01 ? 1 : 0;
    const FuzzyFit curve = fit_descending_curve(problem, center, width, -10.0, 40.0).value();
    ASSERT_LT(worst_rise(curve, -10.0, 40.0).share, 1e-4) << trial;
    ASSERT_GE(curve.consequents.minCoeff(), 0.0) << trial;
    ASSERT_GE((curve.consequents.topRows(4) - curve.consequents.bottomRows(4)).minCoeff(), -1e-9) << trial;
  }
  EXPECT_GT(rising, 5) << "the test would show nothing";
}

}  // namespace
}  // namespace strainwave
