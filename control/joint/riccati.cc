// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/riccati.h"

#include <Eigen/LU>

namespace strainwave {

namespace {

// Each step doubles the horizon: 2^60 samples exceed any joint's life.
constexpr int kMostDoublings = 60;
constexpr double kConverged = 1e-12;

}  // namespace

std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& A, const Eigen::VectorXd& B,
                                             const Eigen::VectorXd& W, double R) {
  using Matrix = Eigen::MatrixXd;
  const Eigen::Index size = W.size();
  // Solved in coordinates z with x = W^(-1/2) z, in which W is the identity.
  const Eigen::VectorXd root = W.cwiseSqrt();
  const Eigen::VectorXd inverse = root.cwiseInverse();
  Matrix step = root.asDiagonal() * A * inverse.asDiagonal();
  const Eigen::VectorXd input = root.asDiagonal() * B;
  Matrix G = input * input.transpose() / R;
  Matrix H = Matrix::Identity(size, size);
  for (int doubling = 0; doubling < kMostDoublings; ++doubling) {
    const Eigen::PartialPivLU<Matrix> lu(Matrix::Identity(size, size) + G * H);
    const Matrix solved = lu.solve(step);
    const Matrix grown = step.transpose() * H * solved;
    G += step * lu.solve(G) * step.transpose();
    step *= solved;
    H += 0.5 * (grown + grown.transpose());
    G = (0.5 * (G + G.transpose())).eval();
    if (!H.allFinite() || !G.allFinite()) return std::nullopt;
    if (grown.cwiseAbs().maxCoeff() <= kConverged * H.cwiseAbs().maxCoeff())
      return Matrix(root.asDiagonal() * H * root.asDiagonal());
  }
  return std::nullopt;
}

}  // namespace strainwave
