// SPDX-License-Identifier: BSD-3-Clause
// The call of SDPA in the child process of sdp_solver.cc. It may print, exit or crash. Only sdpa_call.cc
// includes SDPA's headers.
#pragma once

#include <vector>

#include "design/gains/lmi.h"

namespace strainwave {

enum class SdpaPhase { kPoint = 0, kInfeasible = 1, kUnbounded = 2 };

/// The answer: [phase, iterations, relative gap], the unknowns, then the dual matrix of each inequality, row by row.
inline constexpr std::size_t kSdpaHeader = 3;
std::size_t sdpa_answer_size(const LmiProblem& problem);

std::vector<double> call_sdpa(const LmiProblem& problem, double gap_tolerance);

}  // namespace strainwave
