// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/epgs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/input_error.h"

namespace strainwave {
namespace {

// Rastrigin's function: 11^n local minima in this box, the global one 0 at (0.5, ...).
void rastrigin(const Eigen::VectorXd& x, CostSample& sample) {
  sample.value = 0.0;
  sample.gradient.resize(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double z = x(i) - 0.5;
    const double phase = 2.0 * std::numbers::pi * z;
    sample.value += z * z + 10.0 * (1.0 - std::cos(phase));
    sample.gradient(i) = 2.0 * z + 20.0 * std::numbers::pi * std::sin(phase);
  }
}

const Eigen::VectorXd kLower = Eigen::VectorXd::Constant(4, -5.0);
const Eigen::VectorXd kUpper = Eigen::VectorXd::Constant(4, 5.0);

EpgsOptions options_with(std::uint64_t seed) {
  EpgsOptions options;
  options.seed = seed;
  options.generation_limit = 300;
  options.known_optimum = 0.0;
  options.optimum_tolerance = 1e-6;
  return options;
}

TEST(Epgs, FindsTheGlobalMinimumAmongThousandsOfLocalOnes) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    found += minimise_epgs(rastrigin, kLower, kUpper, options_with(seed)).cost < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(found, 9);
}

TEST(Epgs, TheBestPointIsNeverLost) {
  const EpgsResult result = minimise_epgs(rastrigin, kLower, kUpper, options_with(3));
  ASSERT_EQ(static_cast<int>(result.best_by_generation.size()), result.generations);
  for (std::size_t i = 1; i < result.best_by_generation.size(); ++i) {
    EXPECT_LE(result.best_by_generation[i], result.best_by_generation[i - 1]);
  }
  EXPECT_LE(result.cost, result.best_by_generation.back());
}

TEST(Epgs, TheSeedAndNotTheNumberOfThreadsDecides) {
  EpgsOptions options = options_with(4);
  options.known_optimum = -1.0;
  options.generation_limit = 20;
  const EpgsResult one = minimise_epgs(rastrigin, kLower, kUpper, options);
  options.threads = 4;
  const EpgsResult four = minimise_epgs(rastrigin, kLower, kUpper, options);
  EXPECT_EQ(one.x, four.x);
  EXPECT_EQ(one.evaluations, four.evaluations);
  EXPECT_EQ(one.best_by_generation, four.best_by_generation);
  options.seed = 5;
  EXPECT_NE(minimise_epgs(rastrigin, kLower, kUpper, options).best_by_generation, one.best_by_generation);
}

TEST(Epgs, EveryEvaluationIsInsideTheBox) {
  const GradientCost watched = [](const Eigen::VectorXd& x, CostSample& sample) {
    for (Eigen::Index i = 0; i < x.size(); ++i) ASSERT_TRUE(x(i) >= -5.0 && x(i) <= 5.0);
    rastrigin(x, sample);
  };
  EpgsOptions options = options_with(6);
  options.mutation = 0.9;
  options.generation_limit = 20;
  minimise_epgs(watched, kLower, kUpper, options);
}

TEST(Epgs, SaysWhyItStopped) {
  EpgsOptions options = options_with(7);
  EXPECT_EQ(minimise_epgs(rastrigin, kLower, kUpper, options).stop, EpgsStop::kKnownOptimum);
  options.known_optimum = -1.0;
  options.generation_limit = 3;
  EXPECT_EQ(minimise_epgs(rastrigin, kLower, kUpper, options).stop, EpgsStop::kGenerationLimit);
  options.generation_limit = 10000;
  options.patience = 5;
  EXPECT_EQ(minimise_epgs(rastrigin, kLower, kUpper, options).stop, EpgsStop::kNoImprovement);
}

TEST(Epgs, ToleratesACostThatIsNotANumberSomewhere) {
  const GradientCost broken = [](const Eigen::VectorXd& x, CostSample& sample) {
    rastrigin(x, sample);
    if (x(0) > 0.0) sample.value = std::nan("");
    if (x(1) > 4.0) sample.gradient(0) = std::nan("");
  };
  const EpgsResult result = minimise_epgs(broken, kLower, kUpper, options_with(8));
  EXPECT_TRUE(std::isfinite(result.cost));
  EXPECT_LE(result.x(0), 0.0);
}

TEST(Epgs, RefusesAnEmptyBoxAndAnEmptyPopulation) {
  EXPECT_THROW(minimise_epgs(rastrigin, kLower, kLower, options_with(1)), InputError);
  EpgsOptions options = options_with(1);
  options.population = 1;
  EXPECT_THROW(minimise_epgs(rastrigin, kLower, kUpper, options), InputError);
  options = options_with(1);
  options.crossover = 0.9;
  EXPECT_THROW(minimise_epgs(rastrigin, kLower, kUpper, options), InputError);
}

}  // namespace
}  // namespace strainwave
