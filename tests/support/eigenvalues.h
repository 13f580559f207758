// SPDX-License-Identifier: BSD-3-Clause
// Results of Eigen's own solvers, to which tests compare ours. They are compiled here once: a solver costs
// seconds in every file, and again for every type of matrix.
#pragma once

#include <Eigen/Core>

namespace strainwave::testing {

/// The largest absolute value of an eigenvalue of a square matrix.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// The same for eigenvalues that turn by more than `angle_rad` per step. These belong to oscillating modes.
double swing_radius(const Eigen::MatrixXd& matrix, double angle_rad);

/// The smallest eigenvalue of a symmetric matrix. Only the lower half is read.
double smallest_eigenvalue(const Eigen::MatrixXd& matrix);

}  // namespace strainwave::testing
