// SPDX-License-Identifier: BSD-3-Clause
// Solves the discrete algebraic Riccati equation of a linear plant: the optimal cost without limits. Not real-time.
// Source: Chu, Fan, Lin and Wang, "Structure-preserving algorithms for periodic discrete-time algebraic Riccati
// equations", Int. J. Control 77 (2004): doubling.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace strainwave {

/// Solves  P = A'PA - A'PB (R + B'PB)^-1 B'PA + W.  The least sum of x'Wx + u'Ru along x+ = A x + B u is then x0'P x0.
/// A n x n, B n, W the diagonal of a positive matrix, R > 0. Nothing when (A, B) cannot be stabilised
/// or the doubling does not converge.
std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& A, const Eigen::VectorXd& B,
                                             const Eigen::VectorXd& W, double R);

}  // namespace strainwave
