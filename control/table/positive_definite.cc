// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/positive_definite.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

using bounded_detail::kHalfUlp;

// Powers of two are exact only away from underflow and overflow; no gain table has a matrix beyond this range.
constexpr double kLargestEntry = 0x1p400;

struct Balanced {
  ProofMatrix matrix;
  double error_norm = 0.0;  // bound on the spectral norm of the balanced error
};

bool balanceable(const ProofMatrix& matrix, const ProofMatrix& error, int size) noexcept {
  for (int i = 0; i < size; ++i) {
    if (!(matrix(i, i) >= 1.0 / kLargestEntry)) return false;
    for (int j = 0; j < size; ++j) {
      // Written so that NaN fails.
      if (!(std::abs(matrix(i, j)) <= kLargestEntry) || !(error(i, j) >= 0.0) ||
          !(error(i, j) <= kLargestEntry))
        return false;
    }
  }
  return true;
}

// D * matrix * D with D = diag(2^-round(log2(a_ii)/2)), which brings the diagonal to [0.5, 2).
Balanced balance(const ProofMatrix& matrix, const ProofMatrix& error, int size) noexcept {
  std::array<int, kMaxProofStates> exponent{};
  for (int i = 0; i < size; ++i) {
    exponent[static_cast<std::size_t>(i)] = -((std::ilogb(matrix(i, i)) + 1) >> 1);
  }
  Balanced balanced;
  balanced.matrix.resize(size, size);
  for (int i = 0; i < size; ++i) {
    double row_error = 0.0;
    for (int j = 0; j < size; ++j) {
      const int power = exponent[static_cast<std::size_t>(i)] + exponent[static_cast<std::size_t>(j)];
      const double sum = matrix(i, j) + matrix(j, i);
      balanced.matrix(i, j) = std::ldexp(0.5 * sum, power);
      // The symmetric part costs one rounding unless the two entries were equal.
      const double symmetrising = matrix(i, j) == matrix(j, i) ? 0.0 : kHalfUlp * std::abs(sum);
      row_error += std::ldexp(std::max(error(i, j), error(j, i)) + symmetrising, power);
    }
    balanced.error_norm = std::max(balanced.error_norm, row_error);
  }
  return balanced;
}

}  // namespace

PositiveDefiniteResult test_positive_definite(const ProofMatrix& matrix, const ProofMatrix& error,
                                              int size) noexcept {
  PositiveDefiniteResult result;
  result.margin = -std::numeric_limits<double>::infinity();
  if (!balanceable(matrix, error, size)) return result;
  const Balanced balanced = balance(matrix, error, size);
  double trace = 0.0;
  for (int i = 0; i < size; ++i) trace += balanced.matrix(i, i);
  // When Cholesky succeeds, a positive definite matrix is no farther than gamma_k/(1 - gamma_k) * trace from the given one, k = n + 1
  // (Rump, 2006). This is about k half ulps of the trace. 4 k also covers the rounding of the shift and of this line. The balanced
  // entries are near 1, so that underflow is far below it.
  const double shift = (1.0 + 64.0 * kHalfUlp) * balanced.error_norm + 4.0 * (size + 1) * kHalfUlp * trace;
  ProofMatrix shifted = balanced.matrix;
  for (int i = 0; i < size; ++i) shifted(i, i) -= shift;
  if (!shifted.allFinite()) return result;

  // Valid in any order of summation. An overflow leaves a factor that is not finite, which is no proof.
  const Eigen::LLT<ProofMatrix> cholesky(shifted);
  result.certain = cholesky.info() == Eigen::Success && cholesky.matrixLLT().allFinite();
  const Eigen::SelfAdjointEigenSolver<ProofMatrix> solver(balanced.matrix, Eigen::EigenvaluesOnly);
  const double estimate = solver.eigenvalues()(0) - shift;
  // The estimate has its own rounding; Cholesky decides the sign.
  result.margin =
      result.certain ? std::max(estimate, std::numeric_limits<double>::min()) : std::min(estimate, 0.0);
  return result;
}

}  // namespace strainwave
