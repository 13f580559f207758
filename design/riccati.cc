#include "design/riccati.h"

#include <Eigen/LU>

namespace strainwave {

namespace {

// Each step doubles the horizon: 2^60 samples are more than any joint lives.
constexpr int kMostDoublings = 60;
constexpr double kConverged = 1e-12;

}  // namespace

std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& A, const Eigen::VectorXd& B,
                                             const Eigen::VectorXd& W, double R) {
  const Eigen::Index n = W.size();
  // In z, x = W^(-1/2) z, where the weights are one.
  const Eigen::VectorXd root = W.cwiseSqrt();
  const Eigen::VectorXd inverse = root.cwiseInverse();
  Eigen::MatrixXd step = root.asDiagonal() * A * inverse.asDiagonal();
  const Eigen::VectorXd input = root.asDiagonal() * B;
  Eigen::MatrixXd G = input * input.transpose() / R;
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(n, n);
  for (int doubling = 0; doubling < kMostDoublings; ++doubling) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd::Identity(n, n) + G * H);
    const Eigen::MatrixXd solved = lu.solve(step);
    const Eigen::MatrixXd grown = step.transpose() * H * solved;
    G += step * lu.solve(G) * step.transpose();
    step *= solved;
    H += 0.5 * (grown + grown.transpose());
    G = (0.5 * (G + G.transpose())).eval();
    if (!H.allFinite() || !G.allFinite()) return std::nullopt;
    if (grown.cwiseAbs().maxCoeff() <= kConverged * H.cwiseAbs().maxCoeff())
      return Eigen::MatrixXd(root.asDiagonal() * H * root.asDiagonal());
  }
  return std::nullopt;
}

}  // namespace strainwave
