// SPDX-License-Identifier: BSD-3-Clause
// The polynomial through a point that fits its neighbours best (Savitzky and Golay 1964, here for unequal times):
//
//   q(t) = value + c1 t + c2 t^2 + .. c5 t^5,   sum over the neighbours of (q(ti) - qi)^2 least
//
// With fewer than five neighbours the degree is their number. Real-time safe.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>

namespace strainwave {

class LocalPolynomial {
 public:
  /// Adds a neighbour, at `time_s` after the point; `rise` is its value less the point's.
  void add(double time_s, double rise) noexcept {
    Powers powers;
    double power = 1.0;
    for (int i = 0; i < kDegree; ++i) powers(i) = (power *= time_s / kUnit_s);
    normal_ += powers * powers.transpose();
    moment_ += powers * rise;
    ++fitted_;
  }
  /// First, second and third derivative at the point.
  std::array<double, 3> derivatives() const noexcept {
    Powers c = Powers::Zero();
    const int degree = std::min(kDegree, fitted_);
    if (degree > 0) c.head(degree) = normal_.topLeftCorner(degree, degree).ldlt().solve(moment_.head(degree));
    return {c(0) / kUnit_s, 2.0 * c(1) / (kUnit_s * kUnit_s), 6.0 * c(2) / (kUnit_s * kUnit_s * kUnit_s)};
  }

 private:
  static constexpr int kDegree = 5;
  static constexpr double kUnit_s = 0.1;  ///< unit of time that keeps the equations well conditioned
  using Powers = Eigen::Matrix<double, kDegree, 1>;

  Eigen::Matrix<double, kDegree, kDegree> normal_ = Eigen::Matrix<double, kDegree, kDegree>::Zero();
  Powers moment_ = Powers::Zero();
  int fitted_ = 0;
};

}  // namespace strainwave
