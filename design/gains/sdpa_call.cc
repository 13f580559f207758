// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/sdpa_call.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <sdpa_call.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace strainwave {

namespace {

// SDPA minimises c'x with X = sum x_i F_i - F_0 >= 0. It counts from 1 and takes upper triangles.
void input_block(SDPA& sdpa, int block, const AffineMatrix& inequality) {
  const auto input = [&sdpa, block](int unknown, const Eigen::MatrixXd& matrix, double factor) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = i; j < matrix.cols(); ++j) {
        if (matrix(i, j) == 0.0) continue;
        sdpa.inputElement(unknown, block, static_cast<int>(i) + 1, static_cast<int>(j) + 1,
                          factor * matrix(i, j));
      }
    }
  };
  input(0, inequality.constant(), -1.0);
  for (const auto& [unknown, coefficient] : inequality.coefficients()) input(unknown + 1, coefficient, 1.0);
}

// Reads SDPA's phase as text, because its phase numbers refer to the problem that it calls dual internally.
SdpaPhase classify(SDPA& sdpa) {
  std::array<char, 64> text{};
  sdpa.getPhaseString(text.data());
  std::string phase = text.data();
  while (!phase.empty() && phase.back() == ' ') phase.pop_back();
  if (phase == "pINF_dFEAS" || phase == "pdINF" || phase == "dUNBD") return SdpaPhase::kInfeasible;
  if (phase == "pFEAS_dINF" || phase == "pUNBD") return SdpaPhase::kUnbounded;
  return SdpaPhase::kPoint;
}

}  // namespace

std::size_t sdpa_answer_size(const LmiProblem& problem) {
  std::size_t size = kSdpaHeader + static_cast<std::size_t>(problem.unknown_count());
  for (const AffineMatrix& inequality : problem.inequalities())
    size += static_cast<std::size_t>(inequality.rows() * inequality.rows());
  return size;
}

std::vector<double> call_sdpa(const LmiProblem& problem, double gap_tolerance) {
  SDPA sdpa;
  sdpa.setDisplay(nullptr);
  sdpa.setParameterType(SDPA::PARAMETER_DEFAULT);
  sdpa.setParameterEpsilonStar(gap_tolerance);
  sdpa.setParameterEpsilonDash(gap_tolerance);
  sdpa.setNumThreads(1);
  sdpa.inputConstraintNumber(problem.unknown_count());
  const int blocks = static_cast<int>(problem.inequalities().size());
  sdpa.inputBlockNumber(blocks);
  for (int b = 0; b < blocks; ++b) {
    sdpa.inputBlockSize(b + 1, static_cast<int>(problem.inequalities()[static_cast<std::size_t>(b)].rows()));
    sdpa.inputBlockType(b + 1, SDPA::SDP);
  }
  sdpa.initializeUpperTriangleSpace();
  for (const auto& [unknown, coefficient] : problem.objective().coefficients()) {
    sdpa.inputCVec(unknown + 1, coefficient(0, 0));
  }
  for (int b = 0; b < blocks; ++b)
    input_block(sdpa, b + 1, problem.inequalities()[static_cast<std::size_t>(b)]);
  sdpa.initializeUpperTriangle();
  sdpa.initializeSolve();
  sdpa.solve();

  const double primal = sdpa.getPrimalObj();
  const double dual = sdpa.getDualObj();
  const double gap = std::abs(primal - dual) / std::max(1.0, 0.5 * (std::abs(primal) + std::abs(dual)));
  std::vector<double> answer{static_cast<double>(classify(sdpa)), static_cast<double>(sdpa.getIteration()),
                             gap};
  const double* unknowns = sdpa.getResultXVec();
  answer.insert(answer.end(), unknowns, unknowns + problem.unknown_count());
  for (int b = 0; b < blocks; ++b) {
    const Eigen::Index size = problem.inequalities()[static_cast<std::size_t>(b)].rows();
    const double* dual_matrix = sdpa.getResultYMat(b + 1);
    answer.insert(answer.end(), dual_matrix, dual_matrix + size * size);
  }
  return answer;
}

}  // namespace strainwave
