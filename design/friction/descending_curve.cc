// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/descending_curve.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <vector>

namespace strainwave {

namespace {

using Index = Eigen::Index;

constexpr Index kGrid = 1001;  // temperatures: 0.05 degC apart over the range of Zhao (2006)
constexpr double kRidge = 1e-10;
constexpr double kTolerance = 1e-7;  // relative to the largest parameter
constexpr int kSteps = 400;

Eigen::VectorXd grid(double min_C, double max_C) {
  return Eigen::VectorXd::LinSpaced(kGrid, min_C, max_C);
}

/// U of C = U D, sums from the warm end. D >= 0 means that C >= 0 and falls from rule to rule.
Eigen::MatrixXd sums_from_the_warm_end(Index rules) {
  return Eigen::MatrixXd(Eigen::MatrixXd::Ones(rules, rules).triangularView<Eigen::Upper>());
}

/// The quadratic program min 1/2 x'Hx - g'x, to which rows r'x >= 0 are added one by one. x = [D of static,
/// Coulomb, viscous friction], each in the unit of its own metric.
class GrowingProgram {
 public:
  GrowingProgram(const Eigen::MatrixXd& H, const Eigen::VectorXd& g)
      : factor_(H), free_(factor_.solve(g)), x_(free_) {}

  const Eigen::VectorXd& x() const { return x_; }

  /// Returns false if there is no room for the row.
  bool add(const Eigen::VectorXd& row) {
    if (static_cast<Index>(rows_.size()) == kMaxNonnegativeUnknowns && !forget_idle()) return false;
    rows_.push_back(row);
    solve();
    return true;
  }

 private:
  bool forget_idle() {
    std::vector<Eigen::VectorXd> kept;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (multipliers_(static_cast<Index>(i)) > 0.0) kept.push_back(rows_[i]);
    if (kept.size() == rows_.size()) return false;
    rows_ = std::move(kept);
    return true;
  }

  void solve() {
    const auto count = static_cast<Index>(rows_.size());
    Eigen::MatrixXd G(count, free_.size());
    for (Index i = 0; i < count; ++i) G.row(i) = rows_[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd towards = factor_.solve(G.transpose());
    Eigen::MatrixXd dual = G * towards;
    const Eigen::VectorXd unit = dual.diagonal().cwiseSqrt().cwiseInverse();
    dual = unit.asDiagonal() * dual * unit.asDiagonal();
    dual.diagonal().array() += 1e-12;
    const Eigen::VectorXd wanted = -(unit.asDiagonal() * (G * free_));
    const NonnegativeSolution solution = solve_nonnegative(SmallMatrix(dual), SmallVector(wanted));
    multipliers_ = unit.asDiagonal() * Eigen::VectorXd(solution.x);
    x_ = free_ + towards * multipliers_;
  }

  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd free_;
  Eigen::VectorXd x_;
  std::vector<Eigen::VectorXd> rows_;
  Eigen::VectorXd multipliers_;
};

/// The row of `allowed` that the block of parameter `p` in `x` violates most, or nothing if it violates none.
std::optional<Eigen::VectorXd> most_violated(const Eigen::MatrixXd& allowed, const Eigen::VectorXd& x,
                                             Index p, double tolerance) {
  const Index m = allowed.cols();
  Index worst = 0;
  const double value = (allowed * x.segment(p * m, m)).minCoeff(&worst);
  if (value >= -tolerance) return std::nullopt;
  Eigen::VectorXd row = Eigen::VectorXd::Zero(x.size());
  row.segment(p * m, m) = allowed.row(worst);
  return row;
}

}  // namespace

std::optional<FuzzyFit> fit_descending_curve(const FitProblem& problem, const Eigen::VectorXd& center_C,
                                             const Eigen::VectorXd& width_C, double min_C, double max_C) {
  FuzzyFit fit = fit_consequents(problem, center_C, width_C);
  const Index m = fit.center_C.size();
  const Eigen::MatrixXd U = sums_from_the_warm_end(m);
  const Eigen::MatrixXd basis =
      normalised_memberships(problem.targets.temperature_C, fit.center_C, fit.width_C) * U;
  Eigen::MatrixXd gram = basis.transpose() * basis;
  gram.diagonal().array() += kRidge * gram.trace();
  const Eigen::Vector3d unit = problem.metric.diagonal().cwiseSqrt();
  const Eigen::MatrixX3d right =
      basis.transpose() * problem.targets.parameters * problem.metric * unit.cwiseInverse().asDiagonal();
  Eigen::MatrixXd H(3 * m, 3 * m);
  for (Index p = 0; p < 3; ++p)
    for (Index q = 0; q < 3; ++q)
      H.block(p * m, q * m, m, m) = problem.metric(p, q) / (unit(p) * unit(q)) * gram;

  const Eigen::MatrixXd curve = normalised_memberships(grid(min_C, max_C), fit.center_C, fit.width_C) * U;
  Eigen::MatrixXd allowed(m + kGrid - 1, m);
  allowed << Eigen::MatrixXd::Identity(m, m), curve.topRows(kGrid - 1) - curve.bottomRows(kGrid - 1);

  GrowingProgram program(H, right.reshaped());
  const double tolerance =
      kTolerance * (problem.targets.parameters * unit.asDiagonal()).cwiseAbs().maxCoeff();
  bool holds = false;
  for (int step = 0; step < kSteps && !holds; ++step) {
    holds = true;
    for (Index p = 0; p < 3; ++p) {
      const auto row = most_violated(allowed, program.x(), p, tolerance);
      if (!row) continue;
      if (!program.add(*row)) return std::nullopt;
      holds = false;
    }
  }
  if (!holds) return std::nullopt;
  for (Index p = 0; p < 3; ++p)
    fit.consequents.col(p) = U * program.x().segment(p * m, m).cwiseMax(0.0) / unit(p);
  fit.cost =
      metric_cost(problem.targets.parameters - predict(fit, problem.targets.temperature_C), problem.metric);
  return fit;
}

CurveRise worst_rise(const FuzzyFit& fit, double min_C, double max_C) {
  const Eigen::VectorXd T = grid(min_C, max_C);
  const Eigen::MatrixX3d curve = predict(fit, T);
  CurveRise worst;
  for (Index p = 0; p < 3; ++p) {
    double lowest = curve(0, p);
    for (Index k = 0; k < kGrid; ++k) {
      lowest = std::min(lowest, curve(k, p));
      const double share = lowest > 0.0 ? curve(k, p) / lowest - 1.0 : 0.0;
      if (share > worst.share) worst = {share, T(k), static_cast<int>(p)};
    }
  }
  return worst;
}

}  // namespace strainwave
