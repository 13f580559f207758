// SPDX-License-Identifier: BSD-3-Clause
// Solves an LmiProblem with SDPA. Offline.
//
// SDPA prints, and calls exit() when it cannot continue. It therefore runs in a child process with one thread
// and a time limit, and every failure becomes a status. solve_sdp() checks the result against the
// inequalities, because SDPA's own status word is not a proof.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "design/gains/lmi.h"

namespace strainwave {

enum class SdpStatus {
  kSolved,      ///< optimal to the solver's accuracy, and the inequalities hold to `tolerance`
  kUnbounded,   ///< the objective has no lower bound, according to the solver
  kInaccurate,  ///< the solver stopped early, believes that there is no solution, or its result violates the
                ///< inequalities
  kCrashed,     ///< the solver's process died or could not be started
  kTimeout,     ///< no result within the time limit
};

struct SdpOptions {
  double time_limit_s = 30.0;
  double gap_tolerance = 1e-8;  ///< relative gap of objective and bound that the solver aims at
  double accepted_gap = 1e-5;   ///< largest gap of a solved problem; the certificate checks the gains
  double tolerance = 1e-6;      ///< largest accepted LmiProblem::violation()
};

struct SdpResult {
  SdpStatus status = SdpStatus::kCrashed;
  Eigen::VectorXd unknowns;  ///< empty unless the solver returned a point
  double objective = 0.0;
  double violation = 0.0;              ///< LmiProblem::violation() of `unknowns`
  std::vector<Eigen::MatrixXd> duals;  ///< one per inequality; empty like `unknowns`
  int iterations = 0;
  std::string explanation;  ///< for the user, in words
};

SdpResult solve_sdp(const LmiProblem& problem, const SdpOptions& options = {});

/// A lower bound of sum |x_i| over all solutions x of `problem`. Infinity means that there is no solution,
/// 0 that nothing is proved. Proof: let matrices Y_b >= 0 have sum_b <Y_b, C_b> = -1 over the constants C_b
/// of the inequalities C_b + sum_i x_i A_bi >= 0. Then 0 <= -1 + sum_i x_i sum_b <Y_b, A_bi> for every solution.
/// The solver supplies the Y_b: they are the dual of "minimise t, inequalities + t I >= 0", which always has a
/// solution. The sums are formed here.
double infeasibility_bound(const LmiProblem& problem, const SdpOptions& options = {});

}  // namespace strainwave
