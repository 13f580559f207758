#include "design/fit_checks.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace strainwave {

using Index = Eigen::Index;

namespace {

constexpr Index kLeastKept = 4;

double size_of(const Eigen::RowVector3d& parameters, const Eigen::Matrix3d& metric) {
  return parameters * metric * parameters.transpose();
}

}  // namespace

FitProblem without_row(const FitProblem& problem, Index row) {
  const Index n = problem.targets.temperature_C.size();
  FitProblem others = problem;
  others.targets.temperature_C.resize(n - 1);
  others.targets.parameters.resize(n - 1, 3);
  others.targets.temperature_C << problem.targets.temperature_C.head(row),
      problem.targets.temperature_C.tail(n - 1 - row);
  others.targets.parameters << problem.targets.parameters.topRows(row),
      problem.targets.parameters.bottomRows(n - 1 - row);
  return others;
}

std::vector<Outlier> find_outliers(const FitProblem& problem, double low_C, double high_C) {
  const Index n = problem.targets.temperature_C.size();
  std::vector<Index> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), Index{0});
  std::vector<Outlier> outliers;
  FitProblem kept = problem;
  double cost = fit_exponential(kept, low_C, high_C).cost;
  while (static_cast<Index>(rows.size()) > kLeastKept && static_cast<Index>(outliers.size()) < n / 4) {
    Outlier worst;
    worst.cost = cost;
    worst.cost_without = std::numeric_limits<double>::infinity();
    for (Index row = 0; row < static_cast<Index>(rows.size()); ++row) {
      const ExponentialFit law = fit_exponential(without_row(kept, row), low_C, high_C);
      if (law.cost >= worst.cost_without) continue;
      worst.row = row;
      worst.cost_without = law.cost;
      worst.error =
          kept.targets.parameters.row(row) - predict(law, kept.targets.temperature_C.segment(row, 1)).row(0);
    }
    if (!(worst.cost > kOutlierFactor * worst.cost_without)) break;
    // What fits to the last digit has no outliers, only rounding.
    if (!(worst.cost > 1e-9 * metric_cost(kept.targets.parameters, kept.metric))) break;
    kept = without_row(kept, worst.row);
    cost = worst.cost_without;
    const Index in_kept = worst.row;
    worst.row = rows[static_cast<std::size_t>(in_kept)];
    rows.erase(rows.begin() + in_kept);
    outliers.push_back(worst);
  }
  return outliers;
}

double error_between(const FitProblem& problem, const Prediction& predicted) {
  const Index n = problem.targets.temperature_C.size();
  if (n < kLeastKept) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (Index row = 1; row + 1 < n; ++row) {
    const Eigen::RowVector3d truth = problem.targets.parameters.row(row);
    const Eigen::RowVector3d error =
        truth - predicted(without_row(problem, row), problem.targets.temperature_C(row));
    squares += size_of(error, problem.metric) / size_of(truth, problem.metric);
  }
  return std::sqrt(squares / static_cast<double>(n - 2));
}

}  // namespace strainwave
