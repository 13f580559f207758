// Solves an LmiProblem with SDPA. Offline.
//
// SDPA prints, and calls exit() where it cannot go on. It therefore runs in a child process with one thread
// and a time limit; whatever happens to it comes back as a status. What it returns is checked here against
// the inequalities, because its own status word is not a proof.
#pragma once

#include <Eigen/Core>
#include <string>

#include "design/lmi.h"

namespace strainwave {

enum class SdpStatus {
  kSolved,      ///< optimal to the solver's accuracy, and the inequalities hold to `tolerance`
  kInfeasible,  ///< no unknowns satisfy the inequalities (solver's opinion)
  kUnbounded,   ///< the objective has no lower bound (solver's opinion)
  kInaccurate,  ///< the solver stopped early, or its result violates the inequalities
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
  double violation = 0.0;  ///< of `unknowns`, as LmiProblem::violation()
  int iterations = 0;
  std::string explanation;  ///< for a person, in words
};

SdpResult solve_sdp(const LmiProblem& problem, const SdpOptions& options = {});

}  // namespace strainwave
