// SPDX-License-Identifier: BSD-3-Clause
// A positive-definiteness test that is a proof: when it says yes, every symmetric matrix within the stated
// entrywise error of the argument is positive definite, rounding included. Real-time safe.
//
// The matrix is balanced by a diagonal congruence with powers of two (exact), shifted down by a bound on all
// rounding errors, and factored by Cholesky. Source: Rump, "Verification of positive definiteness", BIT 46 (2006).
#pragma once

#include <Eigen/Core>

#include "control/table/bounded_matrix.h"

namespace strainwave {

struct PositiveDefiniteResult {
  bool certain = false;  ///< proved positive definite
  double margin =
      0.0;  ///< estimate of the smallest eigenvalue after balancing, less the error bound; > 0 when certain
};

/// Tests the leading `size` x `size` block of `matrix` (1 <= size <= kMaxProofStates; only its symmetric part counts).
/// `error` bounds the error of each entry, same block; entries >= 0. NaN or infinity anywhere answers no.
PositiveDefiniteResult test_positive_definite(const ProofMatrix& matrix, const ProofMatrix& error,
                                              int size) noexcept;

}  // namespace strainwave
