// SPDX-License-Identifier: BSD-3-Clause
// Matrices with an error bound for every entry, like the numbers of bounded.h, for whole products. No heap; real-time safe.
//
// For C = A B with k terms per entry, in any order of summation,
//   |C - computed| <= |A| eB + eA |B| + eA eB + (k + 1) u |A| |B|,   u = 2^-53
// The bounds are themselves sums of non-negative terms; kUp covers their rounding. Source: Higham, "Accuracy and Stability of
// Numerical Algorithms", section 3.5.
#pragma once

#include <Eigen/Core>

#include "control/bounded.h"
#include "control/table/certified_box.h"

namespace strainwave {

/// The largest matrix of a proof: the loop of a box.
inline constexpr int kMaxProofStates = loop_states(kSpringPlantStates, kMaxBoxDelay, kMaxLeadPeriods);
using ProofMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxProofStates, kMaxProofStates>;

struct BoundedMatrix {
  ProofMatrix value;
  ProofMatrix error;  ///< >= 0, same shape

  BoundedMatrix() = default;
  /// Zeros.
  BoundedMatrix(Eigen::Index rows, Eigen::Index columns)
      : value(ProofMatrix::Zero(rows, columns)), error(ProofMatrix::Zero(rows, columns)) {}
  /// Taken as exact.
  explicit BoundedMatrix(const ProofMatrix& exact)
      : value(exact), error(ProofMatrix::Zero(exact.rows(), exact.cols())) {}

  void set(Eigen::Index row, Eigen::Index column, const Bounded& entry) noexcept {
    value(row, column) = entry.value;
    error(row, column) = entry.error;
  }
  BoundedMatrix transpose() const { return from(value.transpose(), error.transpose()); }
  /// Largest possible absolute value of every entry.
  ProofMatrix magnitude() const { return kUp * (value.cwiseAbs() + error); }

  static BoundedMatrix from(const ProofMatrix& value, const ProofMatrix& error) {
    BoundedMatrix result(value);
    result.error = error;
    return result;
  }
  /// Covers the rounding of a bound: sums of at most three times kMaxProofStates terms.
  static constexpr double kUp = 1.0 + 128.0 * bounded_detail::kHalfUlp;
};

// Entry by entry: Eigen's blocked products are for larger matrices, and take seconds to compile in every file that multiplies.
inline BoundedMatrix operator*(const BoundedMatrix& a, const BoundedMatrix& b) {
  const ProofMatrix size_a = a.value.cwiseAbs();
  const ProofMatrix size_b = b.value.cwiseAbs();
  const double rounding = static_cast<double>(a.value.cols() + 1) * bounded_detail::kHalfUlp;
  const ProofMatrix inherited = size_a.lazyProduct(ProofMatrix(b.error + rounding * size_b)) +
                                a.error.lazyProduct(ProofMatrix(size_b + b.error));
  return BoundedMatrix::from(a.value.lazyProduct(b.value),
                             (BoundedMatrix::kUp * inherited).array() +
                                 static_cast<double>(a.value.cols()) * bounded_detail::kUnderflow);
}

inline BoundedMatrix operator+(const BoundedMatrix& a, const BoundedMatrix& b) {
  const ProofMatrix sum = a.value + b.value;
  const ProofMatrix error =
      BoundedMatrix::kUp * (a.error + b.error + bounded_detail::kHalfUlp * sum.cwiseAbs());
  return BoundedMatrix::from(sum, error);
}

inline BoundedMatrix operator-(const BoundedMatrix& a, const BoundedMatrix& b) {
  return a + BoundedMatrix::from(-b.value, b.error);
}

/// Multiplies by any number, which costs one rounding for each entry.
inline BoundedMatrix operator*(const Bounded& factor, const BoundedMatrix& a) {
  const ProofMatrix product = factor.value * a.value;
  const ProofMatrix inherited = (std::abs(factor.value) + factor.error) * a.error +
                                factor.error * a.value.cwiseAbs() +
                                bounded_detail::kHalfUlp * product.cwiseAbs();
  return BoundedMatrix::from(product, (BoundedMatrix::kUp * inherited).array() + bounded_detail::kUnderflow);
}

}  // namespace strainwave
