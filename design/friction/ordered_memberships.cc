// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/ordered_memberships.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace strainwave {

namespace {

using Index = Eigen::Index;

// On the shipped catalogue with 3 to 8 rules, 3 to 100 of 200 starts end within 2 % of the best.
constexpr int kStarts = 200;
constexpr int kEvaluations = 150;
constexpr double kCostTolerance = 1e-6;
// Tolerance of r_i, in 1/degC. With widths of 15 degC, a hundredth of a degree changes r_i by more.
constexpr double kOrderTolerance = 1e-6;

/// The variables are the centres, then the logarithms of the widths.
struct Search {
  const FitProblem& problem;
  Index rules;
  double ends_C[2];

  Eigen::VectorXd centers(const double* x) const { return Eigen::Map<const Eigen::VectorXd>(x, rules); }
  Eigen::VectorXd widths(const double* x) const {
    return Eigen::Map<const Eigen::VectorXd>(x + rules, rules).array().exp();
  }
};

double cost(unsigned /*count*/, const double* x, double* gradient, void* data) {
  const Search& search = *static_cast<const Search*>(data);
  const Eigen::VectorXd width = search.widths(x);
  const FuzzyFit fit = fit_consequents(search.problem, search.centers(x), width);
  if (gradient != nullptr) {
    Eigen::Map<Eigen::VectorXd>(gradient, search.rules) = fit.gradient.head(search.rules);
    Eigen::Map<Eigen::VectorXd>(gradient + search.rules, search.rules) =
        fit.gradient.tail(search.rules).cwiseProduct(width);
  }
  return fit.cost;
}

/// r_(i+1) - r_i <= 0 at both ends.
void order(unsigned rows, double* result, unsigned count, const double* x, double* gradient, void* data) {
  const Search& search = *static_cast<const Search*>(data);
  const auto n = static_cast<unsigned>(search.rules);
  if (gradient != nullptr) std::fill(gradient, gradient + std::size_t{rows} * count, 0.0);
  unsigned row = 0;
  for (const double end_C : search.ends_C) {
    for (unsigned i = 0; i + 1 < n; ++i, ++row) {
      result[row] = 0.0;
      for (const unsigned rule : {i, i + 1}) {
        const double sign = rule == i ? -1.0 : 1.0;
        const double per_square = std::exp(-2.0 * x[n + rule]);
        const double r = (end_C - x[rule]) * per_square;
        result[row] += sign * r;
        if (gradient == nullptr) continue;
        gradient[std::size_t{row} * count + rule] = -sign * per_square;
        gradient[std::size_t{row} * count + n + rule] = -2.0 * sign * r;
      }
    }
  }
}

/// A random start. Equal widths are ordered for all centres. The centres are denser in the cold, where friction changes most.
std::vector<double> start(const Search& search, const MembershipBox& box, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto n = static_cast<std::size_t>(search.rules);
  const double width_C = std::clamp(2.0 + 6.0 * uniform(random), box.width_min_C, box.width_max_C);
  std::vector<double> x(2 * n, std::log(width_C));
  for (std::size_t i = 0; i < n; ++i)
    x[i] = std::lerp(search.ends_C[0], search.ends_C[1], std::pow(uniform(random), 1.5));
  std::sort(x.begin(), x.begin() + search.rules);
  return x;
}

}  // namespace

FuzzyFit fit_ordered_memberships(const FitProblem& problem, int rules, const MembershipBox& box, double min_C,
                                 double max_C, std::uint64_t seed) {
  Search search{problem, rules, {min_C, max_C}};
  const auto n = static_cast<unsigned>(rules);
  const std::size_t unknowns = std::size_t{2} * n;
  const std::size_t inequalities = std::size_t{2} * (n - 1);
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(nlopt_create(NLOPT_LD_SLSQP, 2 * n),
                                                                         &nlopt_destroy);
  std::vector<double> lower(unknowns, box.center_min_C), upper(unknowns, box.center_max_C);
  std::fill(lower.begin() + rules, lower.end(), std::log(box.width_min_C));
  std::fill(upper.begin() + rules, upper.end(), std::log(box.width_max_C));
  const std::vector<double> tolerance(inequalities, kOrderTolerance);
  nlopt_set_lower_bounds(optimiser.get(), lower.data());
  nlopt_set_upper_bounds(optimiser.get(), upper.data());
  nlopt_set_min_objective(optimiser.get(), cost, &search);
  nlopt_add_inequality_mconstraint(optimiser.get(), 2 * (n - 1), order, &search, tolerance.data());
  nlopt_set_maxeval(optimiser.get(), kEvaluations);
  nlopt_set_ftol_rel(optimiser.get(), kCostTolerance);
  std::mt19937_64 random(seed);
  std::vector<double> best = start(search, box, random);
  double least = cost(2 * n, best.data(), nullptr, &search);
  std::vector<double> disorder(tolerance.size());
  for (int i = 0; i < kStarts; ++i) {
    std::vector<double> x = start(search, box, random);
    double value = 0.0;
    // A search that ends early by rounding leaves its best point in x. It is judged like any other.
    (void)nlopt_optimize(optimiser.get(), x.data(), &value);
    order(static_cast<unsigned>(disorder.size()), disorder.data(), 2 * n, x.data(), nullptr, &search);
    value = cost(2 * n, x.data(), nullptr, &search);
    if (*std::max_element(disorder.begin(), disorder.end()) > kOrderTolerance || !(value < least)) continue;
    least = value;
    best = x;
  }
  return fit_consequents(problem, search.centers(best.data()), search.widths(best.data()));
}

}  // namespace strainwave
