// The discrete algebraic Riccati equation of one linear plant: the optimal cost without limits. Offline.
// Source: Chu, Fan, Lin and Wang, "Structure-preserving algorithms for periodic discrete-time algebraic Riccati
// equations", Int. J. Control 77 (2004): doubling.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace strainwave {

/// P of  P = A'PA - A'PB (R + B'PB)^-1 B'PA + W,  so that the least sum x'Wx + u'Ru of x+ = A x + B u is
/// x0'P x0. A n x n, B n, W the diagonal of a positive matrix, R > 0. Nothing when (A, B) cannot be stabilised
/// or the doubling does not converge.
std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& A, const Eigen::VectorXd& B,
                                             const Eigen::VectorXd& W, double R);

}  // namespace strainwave
