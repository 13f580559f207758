// SPDX-License-Identifier: BSD-3-Clause
// EPGS, evolutionary parallel gradient search: the minimum of a cost with a gradient over a box. Offline.
// Source: Zhao (2006), section 4.1.
//
// X is a population of P points and f the cost. A steep slope may lead far down, so that the promise of a point is
//   g(X) = f(X) - slope_weight |grad f(X)|.
// Each generation:
//   1. evaluate; stop on the generation limit, on no improvement, or within tolerance of a known optimum;
//   2. the clone_by_cost * P best by f and the clone_by_promise * P best of the rest by g take gradient steps
//      and go on to the next generation;
//   3. crossover * P children:  X' = r Xa + (1 - r) Xb,
//      r uniform in [0, 1], Xa from those selected, Xb from the rest;
//   4. a child's variable mutates when |q| < mutation, q uniform in [-1, 1], by q times its range;
//   5. the rest of the population is drawn afresh; everything is clamped to the box. The best point is never
//      lost.
//
// Where this departs from Zhao (2006), and why:
// - a gradient step is a damped Newton step in the unit box (box_descent.h) instead of a fixed learning rate:
//   costs with long curved valleys, such as that of the fuzzy memberships, otherwise take thousands of
//   generations. A point takes up to `steps` steps in a generation and stops once it has converged;
// - variables are scaled to [0, 1] (the ranges differ by up to 1e4);
// - points that coincide count once: a fresh point takes the place of a copy;
// - each variable of a child mutates independently.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/friction/box_descent.h"

namespace strainwave {

struct EpgsOptions {
  int population = 40;
  double clone_by_cost = 0.3;     ///< A1
  double clone_by_promise = 0.3;  ///< A2
  double crossover = 0.3;         ///< Ac; what remains of 1 is drawn afresh
  double mutation = 0.15;         ///< m
  double slope_weight = 0.01;     ///< of |grad f| in g
  int steps = 20;                 ///< gradient steps per selected point and generation
  /// A point has converged when a step promises less than this part of its cost.
  double step_tolerance = 1e-6;
  /// At the end, the best point takes steps until one promises less than this part.
  double final_tolerance = 1e-12;
  int generation_limit = 250;
  int patience = 1000000;         ///< generations without improvement before stopping
  double improvement = 1e-6;      ///< least relative decrease that counts as one
  double known_optimum = -1e300;  ///< stop within optimum_tolerance of it
  double optimum_tolerance = 0.0;
  std::uint64_t seed = 1;
  int threads = 1;  ///< evaluations run in parallel; the result does not depend on it
};

enum class EpgsStop { kGenerationLimit, kNoImprovement, kKnownOptimum };
const char* name_of(EpgsStop stop);

struct EpgsResult {
  Eigen::VectorXd x;  ///< best point, in the caller's units
  double cost = 0.0;
  EpgsStop stop = EpgsStop::kGenerationLimit;
  int generations = 0;
  std::int64_t evaluations = 0;
  std::vector<double> best_by_generation;  ///< never rises
};

/// `cost` takes points of the box [lower, upper] and gives derivatives over the same variables. Throws
/// InputError if the box is empty or the options give no valid population.
EpgsResult minimise_epgs(const GradientCost& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                         const EpgsOptions& options);

}  // namespace strainwave
