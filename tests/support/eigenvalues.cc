// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace strainwave::testing {

double spectral_radius(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
}

double swing_radius(const Eigen::MatrixXd& matrix, double angle_rad) {
  const auto eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().array().eval();
  return (eigenvalues.arg().abs() > angle_rad).select(eigenvalues.abs(), 0.0).maxCoeff();
}

double smallest_eigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

}  // namespace strainwave::testing
