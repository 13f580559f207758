// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/fit_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

namespace {

/// Removes the temperatures of a problem one after the other.
class Removal {
 public:
  Removal(const FitProblem& problem, double low_C, double high_C)
      : low_C_(low_C),
        high_C_(high_C),
        rows_(static_cast<std::size_t>(problem.targets.temperature_C.size())),
        kept_(problem) {
    std::iota(rows_.begin(), rows_.end(), Index{0});
    cost_ = law_of(kept_).cost;
  }

  /// Removes the temperature without which the law fits the others best. Returns the factor by which the cost falls.
  double take_worst() {
    const double before = cost_;
    cost_ = std::numeric_limits<double>::infinity();
    Index worst = 0;
    for (Index row = 0; row < size(); ++row) {
      const double cost = law_of(without_row(kept_, row)).cost;
      if (cost >= cost_) continue;
      worst = row;
      cost_ = cost;
    }
    taken_.push_back(rows_[static_cast<std::size_t>(worst)]);
    rows_.erase(rows_.begin() + worst);
    kept_ = without_row(kept_, worst);
    // A fit that is exact up to rounding has no outliers.
    return before > 1e-9 * metric_cost(kept_.targets.parameters, kept_.metric) ? before / cost_ : 1.0;
  }

  Index size() const { return static_cast<Index>(rows_.size()); }
  /// Rows of the problem, in the order of their removal.
  const std::vector<Index>& taken() const { return taken_; }
  ExponentialFit law_of(const FitProblem& problem) const { return fit_exponential(problem, low_C_, high_C_); }

 private:
  double low_C_;
  double high_C_;
  std::vector<Index> rows_;
  FitProblem kept_;
  double cost_ = 0.0;
  std::vector<Index> taken_;
};

FitProblem without_rows(FitProblem problem, std::vector<Index> rows) {
  std::sort(rows.begin(), rows.end(), std::greater<>());
  for (const Index row : rows) problem = without_row(problem, row);
  return problem;
}

}  // namespace

std::vector<Outlier> find_outliers(const FitProblem& problem, double low_C, double high_C) {
  Removal removal(problem, low_C, high_C);
  const auto most = static_cast<std::size_t>(removal.size() / 4);
  std::size_t suspects = 0;
  // Outliers that pull the law the same way mask each other: it fits only without the last of them.
  while (removal.size() > kLeastKept && removal.taken().size() < std::min(most, suspects + kHidingOutliers))
    if (removal.take_worst() > kOutlierFactor) suspects = removal.taken().size();
  const std::vector<Index> taken(removal.taken().begin(),
                                 removal.taken().begin() + static_cast<std::ptrdiff_t>(suspects));

  std::vector<Outlier> outliers;
  if (taken.empty()) return outliers;
  const ExponentialFit sound = removal.law_of(without_rows(problem, taken));
  for (const Index row : taken) {
    std::vector<Index> others = taken;
    std::erase(others, row);
    const double cost = removal.law_of(without_rows(problem, others)).cost;
    if (!(cost > kOutlierFactor * sound.cost)) continue;  // sound, but removed before a masked outlier
    outliers.push_back({row, cost, sound.cost,
                        problem.targets.parameters.row(row) -
                            predict(sound, problem.targets.temperature_C.segment(row, 1)).row(0)});
  }
  return outliers;
}

double growth_with_temperature(const FitProblem& problem) {
  const Index n = problem.targets.temperature_C.size();
  const Index half = n / 2;
  double cold = 0.0;
  double warm = 0.0;
  for (Index row = 0; row < half; ++row) {
    cold += size_of(problem.targets.parameters.row(row), problem.metric);
    warm += size_of(problem.targets.parameters.row(n - 1 - row), problem.metric);
  }
  return half == 0 ? 1.0 : std::sqrt(warm / cold);
}

}  // namespace strainwave
