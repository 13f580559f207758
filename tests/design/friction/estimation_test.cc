// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/estimation.h"

#include <gtest/gtest.h>

#include <thread>

namespace strainwave {
namespace {

FitProblem source_problem(bool physical) {
  const FrictionData data = read_catalogue(STRAINWAVE_SOURCE_DIR "/data/friction_parameters.csv");
  return {fit_targets(data), friction_metric(FitWeighting::kSource, data.motor_speeds_rpm), physical};
}

constexpr int kSeeds = 20;

// Counts the searches that reach the target. Each search stops there, because a better result does not matter.
template <typename Run>
int count_reached(double target, EpgsOptions options, const Run& run) {
  options.known_optimum = target;
  options.threads = static_cast<int>(std::thread::hardware_concurrency());
  int reached = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    reached += run(options) <= target ? 1 : 0;
  }
  return reached;
}

TEST(Estimation, TheExponentialLawReachesItsOptimum) {
  const FitProblem problem = source_problem(true);
  const int reached = count_reached(0.905, exponential_search_options(), [&](const EpgsOptions& options) {
    return estimate_exponential(problem, 1.0, 500.0, options).fit.cost;
  });
  EXPECT_GE(reached, 19);
}

TEST(Estimation, ThePhysicalFuzzyRulesReachTheirTarget) {
  const FitProblem problem = source_problem(true);
  const int reached = count_reached(0.0100, fuzzy_search_options(), [&](const EpgsOptions& options) {
    const FuzzyFit fit = estimate_fuzzy(problem, 5, {}, options).fit;
    EXPECT_GE(fit.consequents.minCoeff(), 0.0);
    EXPECT_GE((fit.consequents.topRows(4) - fit.consequents.bottomRows(4)).minCoeff(), -1e-12);
    return fit.cost;
  });
  EXPECT_GE(reached, 19);
}

TEST(Estimation, TheUnconstrainedFuzzyRulesReachTheirTarget) {
  const FitProblem problem = source_problem(false);
  const int reached = count_reached(0.0075, fuzzy_search_options(), [&](const EpgsOptions& options) {
    return estimate_fuzzy(problem, 5, {}, options).fit.cost;
  });
  EXPECT_GE(reached, 18);
}

TEST(Estimation, MembershipsStayInTheirBox) {
  EpgsOptions options = fuzzy_search_options();
  options.generation_limit = 10;
  const MembershipBox box{-12.0, 30.0, 2.0, 9.0};
  const FuzzyFit fit = estimate_fuzzy(source_problem(true), 4, box, options).fit;
  EXPECT_GE(fit.center_C.minCoeff(), -12.0);
  EXPECT_LE(fit.center_C.maxCoeff(), 30.0);
  EXPECT_GE(fit.width_C.minCoeff(), 2.0);
  EXPECT_LE(fit.width_C.maxCoeff(), 9.0);
}

TEST(Estimation, BeatsGivenMembershipsByFar) {
  const FitProblem problem = source_problem(true);
  const Memberships given = graded_memberships(5, -10.0, 40.0);
  EpgsOptions options = fuzzy_search_options();
  options.generation_limit = 30;
  EXPECT_LT(estimate_fuzzy(problem, 5, {}, options).fit.cost,
            0.2 * fit_consequents(problem, given.center_C, given.width_C).cost);
}

}  // namespace
}  // namespace strainwave
