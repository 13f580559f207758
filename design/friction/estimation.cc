// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/estimation.h"

namespace strainwave {

using Index = Eigen::Index;

EpgsOptions fuzzy_search_options() {
  return {};
}

EpgsOptions exponential_search_options() {
  EpgsOptions options;
  options.population = 10;
  options.generation_limit = 20;
  options.patience = 5;
  return options;
}

GradientCost fuzzy_cost(const FitProblem& problem) {
  return [problem](const Eigen::VectorXd& x, CostSample& sample) {
    const Index m = x.size() / 2;
    FuzzyFit fit = fit_consequents(problem, x.head(m), x.tail(m));
    sample.value = fit.cost;
    sample.gradient = std::move(fit.gradient);
    sample.curvature = std::move(fit.curvature);
  };
}

GradientCost exponential_cost(const FitProblem& problem) {
  return [problem](const Eigen::VectorXd& x, CostSample& sample) {
    const ExponentialFit fit = fit_exponential_at(problem, x(0));
    sample.value = fit.cost;
    sample.gradient = Eigen::VectorXd::Constant(1, fit.gradient);
    sample.curvature = Eigen::MatrixXd::Constant(1, 1, fit.curvature);
  };
}

Estimate<FuzzyFit> estimate_fuzzy(const FitProblem& problem, int rules, const MembershipBox& box,
                                  const EpgsOptions& options) {
  Eigen::VectorXd lower(2 * rules), upper(2 * rules);
  lower << Eigen::VectorXd::Constant(rules, box.center_min_C),
      Eigen::VectorXd::Constant(rules, box.width_min_C);
  upper << Eigen::VectorXd::Constant(rules, box.center_max_C),
      Eigen::VectorXd::Constant(rules, box.width_max_C);
  Estimate<FuzzyFit> estimate;
  estimate.search = minimise_epgs(fuzzy_cost(problem), lower, upper, options);
  estimate.fit = fit_consequents(problem, estimate.search.x.head(rules), estimate.search.x.tail(rules));
  return estimate;
}

Estimate<ExponentialFit> estimate_exponential(const FitProblem& problem, double low_C, double high_C,
                                              const EpgsOptions& options) {
  Estimate<ExponentialFit> estimate;
  estimate.search = minimise_epgs(exponential_cost(problem), Eigen::VectorXd::Constant(1, low_C),
                                  Eigen::VectorXd::Constant(1, high_C), options);
  estimate.fit = fit_exponential_at(problem, estimate.search.x(0));
  return estimate;
}

}  // namespace strainwave
