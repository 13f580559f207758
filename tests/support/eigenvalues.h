// SPDX-License-Identifier: BSD-3-Clause
// What Eigen's own solvers say of a matrix, for tests that judge ours by them. Compiled once: a solver costs seconds in every file, and
// again for every type of matrix.
#pragma once

#include <Eigen/Core>

namespace strainwave::testing {

/// The largest absolute value of an eigenvalue of a square matrix.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// The same of those eigenvalues that turn by more than `angle_rad` in a step: of what swings, not of what creeps.
double swing_radius(const Eigen::MatrixXd& matrix, double angle_rad);

/// Of a symmetric matrix, of which the lower half is read.
double smallest_eigenvalue(const Eigen::MatrixXd& matrix);

}  // namespace strainwave::testing
