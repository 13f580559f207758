// SPDX-License-Identifier: BSD-3-Clause
#include "design/exact/least_fall.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

namespace strainwave {

namespace {

// Fractions are rounded to 1 / kParts. Powers of two alone lose proofs near the limit (verify --exact).
constexpr double kParts = 64.0;

Eigen::MatrixXd approximate(const RationalMatrix& a) {
  Eigen::MatrixXd result(a.rows(), a.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j)
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = a(i, j).get_d();
  return result;
}

}  // namespace

mpq_class short_number_near(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return std::ldexp(std::round(kParts * fraction) / kParts, exponent);
}

bool falls(const RationalMatrix& allowed, const RationalMatrix& P, const Enclosure& loop,
           const mpq_class& factor) {
  const std::size_t n = P.rows();
  const RationalMatrix& H = loop.value;
  const RationalMatrix& X = loop.radius;
  const RationalMatrix PH = P * H;
  RationalMatrix fall = allowed - factor * (transpose(H) * PH);

  // The largest value of each state, and of each row of P H, where the decrease is 1. Only the choice of l uses it.
  const Eigen::LLT<Eigen::MatrixXd> factors(approximate(fall));
  const auto N = static_cast<Eigen::Index>(n);
  const Eigen::MatrixXd rows = factors.matrixL().solve(Eigen::MatrixXd(approximate(PH).transpose()));
  const Eigen::MatrixXd states = factors.matrixL().solve(Eigen::MatrixXd::Identity(N, N));
  const Eigen::VectorXd row_reach = rows.colwise().norm().transpose();
  const Eigen::VectorXd state_reach = states.colwise().norm().transpose();
  const auto at = [](const Eigen::VectorXd& reach, std::size_t i) {
    return reach(static_cast<Eigen::Index>(i));
  };

  RationalMatrix a(n, n);
  RationalMatrix less(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (X(i, j) == 0) continue;
      const mpq_class l = short_number_near(at(state_reach, j) / at(row_reach, i));
      a(i, i) += X(i, j) * l;
      less(j, j) += X(i, j) / l;
    }
  fall = fall - factor * (transpose(PH) * (a * PH) + less);

  const RationalMatrix R = transpose(X) * (magnitude(P) * X);
  std::vector<mpq_class> scale;  // s
  for (std::size_t i = 0; i < n; ++i) scale.push_back(short_number_near(1.0 / std::sqrt(fall(i, i).get_d())));
  RationalMatrix second(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) second(i, i) += R(i, j) * scale[j] / scale[i];
  fall = fall - factor * second;
  return is_positive_definite(fall);
}

}  // namespace strainwave
