#include "design/estimation.h"

#include <algorithm>
#include <numeric>

namespace strainwave {

namespace {

using Index = Eigen::Index;

// Rules can be exchanged without changing the cost: ascending centres name one order.
void sort_rules(Eigen::VectorXd& x) {
  const Index m = x.size() / 2;
  std::vector<Index> order(static_cast<std::size_t>(m));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&x](Index i) { return x(i); });
  const Eigen::VectorXd centers = x.head(m)(order);
  const Eigen::VectorXd widths = x.tail(m)(order);
  x << centers, widths;
}

}  // namespace

EpgsOptions fuzzy_search_options() {
  EpgsOptions options;
  options.canonical = sort_rules;
  return options;
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
