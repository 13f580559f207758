// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

FitProblem source_problem(FitWeighting weighting = FitWeighting::kSource, bool physical = true) {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/friction_parameters.csv");
  return {fit_targets(data), friction_metric(weighting, data.motor_speeds_rpm), physical};
}

struct Point {
  Eigen::VectorXd center, width;
};

Point random_memberships(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  return {Eigen::VectorXd::NullaryExpr(5, [&] { return -15.0 + 60.0 * uniform(random); }),
          Eigen::VectorXd::NullaryExpr(5, [&] { return 2.0 + 13.0 * uniform(random); })};
}

TEST(FrictionFit, TheExponentialOptimumIsKnown) {
  const ExponentialFit fit = fit_exponential(source_problem(), 1.0, 500.0);
  EXPECT_NEAR(fit.cost, 0.9036, 5e-5);
  EXPECT_NEAR(fit.decay_C, 11.25, 0.01);
  EXPECT_NEAR(fit.gradient, 0.0, 1e-5);
}

TEST(FrictionFit, RecoversTheParametersThatMadeTheData) {
  ExponentialFit truth;
  truth.reference_C = -10.0;
  truth.decay_C = 17.0;
  truth.p0 << 3.0, 1.4, 1e-3;
  truth.p1 << 5.0, 4.0, 9e-3;
  for (const FitWeighting weighting : {FitWeighting::kSource, FitWeighting::kTorque}) {
    FitProblem problem = source_problem(weighting);
    problem.targets.parameters = predict(truth, problem.targets.temperature_C);
    const ExponentialFit fit = fit_exponential(problem, 1.0, 500.0);
    EXPECT_NEAR(fit.decay_C, truth.decay_C, 1e-4);
    EXPECT_TRUE(fit.p0.isApprox(truth.p0, 1e-5));
    EXPECT_TRUE(fit.p1.isApprox(truth.p1, 1e-5));
  }
}

TEST(FrictionFit, TheSourcesTable4CostsWhatTheTheoryPageSays) {
  const FitProblem problem = source_problem();
  FuzzyFit table4;
  table4.center_C = Eigen::VectorXd{{-12.266, -6.3269, -3.0956, 11.033, 21.224}};
  table4.width_C = Eigen::VectorXd{{1.106, 1.0367, 2.1594, 7.4413, 9.8052}};
  table4.consequents.resize(5, 3);
  table4.consequents << 8.8059, 7.2059, 0.0097752, 6.9638, 5.3638, 0.008942, 5.9136, 4.3136, 0.0063127, 4.560,
      2.960, 0.004052, 3.1927, 1.5927, 0.0011374;
  const Eigen::MatrixX3d errors = problem.targets.parameters - predict(table4, problem.targets.temperature_C);
  EXPECT_NEAR(metric_cost(errors, problem.metric), 0.2567, 5e-5);
  EXPECT_LT(fit_consequents(problem, table4.center_C, table4.width_C).cost, 0.2567);
}

// Compares the derivatives with central differences of the projected cost. The cost has twelve digits, so the step is 1e-5.
TEST(FrictionFit, GradientsAreTheDerivativesOfTheProjectedCost) {
  std::mt19937_64 random(1);
  int constrained = 0;
  for (const bool physical : {true, false}) {
    for (const FitWeighting weighting : {FitWeighting::kSource, FitWeighting::kTorque}) {
      const FitProblem problem = source_problem(weighting, physical);
      for (int trial = 0; trial < 30; ++trial) {
        const Point point = random_memberships(random);
        const FuzzyFit fit = fit_consequents(problem, point.center, point.width);
        const Eigen::MatrixX3d& C = fit.consequents;
        constrained += (C.topRows(4) - C.bottomRows(4)).minCoeff() < 1e-12 ? 1 : 0;
        for (Eigen::Index i = 0; i < 10; ++i) {
          Point above = point, below = point;
          (i < 5 ? above.center(i) : above.width(i - 5)) += 1e-5;
          (i < 5 ? below.center(i) : below.width(i - 5)) -= 1e-5;
          const double difference = (fit_consequents(problem, above.center, above.width).cost -
                                     fit_consequents(problem, below.center, below.width).cost) /
                                    2e-5;
          ASSERT_NEAR(fit.gradient(i), difference, 1e-4 * (1.0 + fit.gradient.norm())) << i;
        }
      }
    }
  }
  EXPECT_GT(constrained, 20);  // the fits had active constraints, so that the envelope theorem mattered
}

TEST(FrictionFit, CurvatureIsSymmetricAndNotNegative) {
  std::mt19937_64 random(2);
  for (const bool physical : {true, false}) {
    const FitProblem problem = source_problem(FitWeighting::kTorque, physical);
    for (int trial = 0; trial < 30; ++trial) {
      const Point point = random_memberships(random);
      const Eigen::MatrixXd B = fit_consequents(problem, point.center, point.width).curvature;
      const Eigen::VectorXd probe = Eigen::VectorXd::Random(10);
      ASSERT_TRUE(B.isApprox(B.transpose(), 1e-9));
      ASSERT_GE(probe.dot(B * probe), -1e-9 * B.norm());
    }
  }
}

TEST(FrictionFit, PhysicalConsequentsAreNonNegativeAndNeverRise) {
  std::mt19937_64 random(3);
  const FitProblem problem = source_problem();
  for (int trial = 0; trial < 200; ++trial) {
    const Point point = random_memberships(random);
    const FuzzyFit fit = fit_consequents(problem, point.center, point.width);
    ASSERT_GE(fit.consequents.minCoeff(), 0.0);
    ASSERT_GE((fit.consequents.topRows(4) - fit.consequents.bottomRows(4)).minCoeff(), -1e-12);
    ASSERT_TRUE(std::is_sorted(fit.center_C.begin(), fit.center_C.end()));
    const FuzzyFit free =
        fit_consequents(source_problem(FitWeighting::kSource, false), point.center, point.width);
    ASSERT_LE(free.cost, fit.cost * (1.0 + 1e-9));
  }
}

TEST(FrictionFit, TheOrderOfTheRulesDoesNotMatter) {
  const FitProblem problem = source_problem();
  const Eigen::VectorXd center{{-10.0, 0.0, 10.0, 20.0, 30.0}}, width{{3.0, 4.0, 5.0, 6.0, 7.0}};
  const FuzzyFit a = fit_consequents(problem, center, width);
  const FuzzyFit b = fit_consequents(problem, center.reverse(), width.reverse());
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_TRUE(
      Eigen::VectorXd(a.gradient.head(5)).isApprox(Eigen::VectorXd(b.gradient.head(5).reverse()), 1e-12));
}

TEST(FrictionFit, RulesThatCoincideOrSeeNoDataDoNoHarm) {
  const FitProblem problem = source_problem();
  const FuzzyFit twins =
      fit_consequents(problem, Eigen::VectorXd{{5.0, 5.0, 20.0}}, Eigen::VectorXd{{6.0, 6.0, 8.0}});
  EXPECT_TRUE(twins.consequents.allFinite() && std::isfinite(twins.cost) && twins.gradient.allFinite());
  const FuzzyFit blind =
      fit_consequents(problem, Eigen::VectorXd{{0.0, 20.0, 400.0}}, Eigen::VectorXd{{6.0, 9.0, 1.0}});
  EXPECT_TRUE(blind.consequents.allFinite() && std::isfinite(blind.cost) && blind.gradient.allFinite());
}

TEST(FrictionFit, TheTorqueMetricIsTheMeanErrorOfTheTorque) {
  const std::vector<double> speeds{500.0, 1000.0, 2000.0, 3500.0};
  const Eigen::Matrix3d metric = friction_metric(FitWeighting::kTorque, speeds);
  Eigen::MatrixX3d errors(1, 3);
  errors << 0.3, -0.2, 4e-4;
  double expected = 0.3 * 0.3;
  for (const double speed : speeds) expected += std::pow(-0.2 + 4e-4 * speed, 2) / 4.0;
  EXPECT_NEAR(metric_cost(errors, metric), 0.5 * expected, 1e-15);
}

TEST(FrictionFit, JointSideRulesAreTable5OfTable4) {
  FuzzyFit fit;
  fit.center_C = Eigen::VectorXd{{0.0, 10.0}};
  fit.width_C = Eigen::VectorXd{{5.0, 5.0}};
  fit.consequents.resize(2, 3);
  fit.consequents << 8.8059, 7.2059, 0.0097752, 1.0, 1.0, 1e-3;
  const FuzzyFriction friction = to_joint_side(fit, 50.0, -10.0, 40.0);
  EXPECT_NEAR(friction.rules[0].friction.static_Nm, 4.40295, 1e-12);
  EXPECT_NEAR(friction.rules[0].friction.viscous_Nms_rad, 24.438 * 0.01 * 60.0 / (2.0 * 3.14159265358979),
              1e-9);
}

}  // namespace
}  // namespace strainwave
