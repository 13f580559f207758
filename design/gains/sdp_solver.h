// SPDX-License-Identifier: BSD-3-Clause
// Solves an LmiProblem with SDPA. Offline.
//
// SDPA prints, and calls exit() where it cannot go on. It therefore runs in a child process with one thread
// and a time limit; whatever happens to it comes back as a status. What it returns is checked here against
// the inequalities, because its own status word is not a proof.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "design/gains/lmi.h"

namespace strainwave {

enum class SdpStatus {
  kSolved,      ///< optimal to the solver's accuracy, and the inequalities hold to `tolerance`
  kUnbounded,   ///< the objective has no lower bound (solver's opinion)
  kInaccurate,  ///< the solver stopped early, believes that there is no solution, or its result violates the
                ///< inequalities
  kCrashed,     ///< the solver's process died or could not be started
  kTimeout,     ///< no result within the time limit
};

struct SdpOptions {
  double time_limit_s = 30.0;
  double gap_tolerance =
      1e-8;  ///< relative gap between the objective and its bound that the solver is asked for
  double accepted_gap =
      1e-5;  ///< gap with which a result still counts as solved (gains are certified, not believed)
  double tolerance = 1e-6;  ///< largest accepted LmiProblem::violation()
};

struct SdpResult {
  SdpStatus status = SdpStatus::kCrashed;
  Eigen::VectorXd unknowns;  ///< empty unless the solver returned a point
  double objective = 0.0;
  double violation = 0.0;              ///< of `unknowns`, as LmiProblem::violation()
  std::vector<Eigen::MatrixXd> duals;  ///< one per inequality; empty like `unknowns`
  int iterations = 0;
  std::string explanation;  ///< for a person, in words
};

SdpResult solve_sdp(const LmiProblem& problem, const SdpOptions& options = {});

/// How large the unknowns x of any solution would have to be: sum |x_i| >= the result, infinity at best, 0 when
/// nothing is proved. Proof: matrices Y_b >= 0 with sum_b <Y_b, C_b> = -1 over the constants C_b of the
/// inequalities C_b + sum_i x_i A_bi >= 0. If x satisfied them, then 0 <= -1 + sum_i x_i sum_b <Y_b, A_bi>. The
/// Y_b come from the solver (the dual of: minimise t, inequalities + t I >= 0, which has a solution whatever
/// `problem` is); the sums are formed here.
double infeasibility_bound(const LmiProblem& problem, const SdpOptions& options = {});

}  // namespace strainwave
