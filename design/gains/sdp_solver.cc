// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/sdp_solver.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <optional>
#include <system_error>
#include <vector>

#include "base/unique_fd.h"
#include "design/gains/sdpa_call.h"

namespace strainwave {

namespace {

// Silences the child, limits its CPU time, solves, and writes the result to the pipe as bytes. Never returns. The parent alone holds the
// pipe's other end: when the parent is killed, the write ends the child.
[[noreturn]] void run_child(const LmiProblem& problem, const SdpOptions& options, int result_fd) {
  const int null_fd = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null_fd, standard);
  for (const int fatal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGTERM, SIGINT, SIGPIPE})
    ::signal(fatal, SIG_DFL);
  const auto seconds = static_cast<rlim_t>(std::ceil(options.time_limit_s)) + 1;
  const rlimit cpu{seconds, seconds};
  const rlimit core{0, 0};
  ::setrlimit(RLIMIT_CPU, &cpu);
  ::setrlimit(RLIMIT_CORE, &core);

  const std::vector<double> answer = call_sdpa(problem, options.gap_tolerance);
  const auto* bytes = reinterpret_cast<const char*>(answer.data());
  std::size_t left = answer.size() * sizeof(double);
  while (left > 0) {
    const ssize_t written = ::write(result_fd, bytes, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    bytes += written;
    left -= static_cast<std::size_t>(written);
  }
  ::_exit(left == 0 ? 0 : 1);
}

enum class ReadOutcome { kWhole, kEnded, kTimeout };

// Fills `answer`, unless the child closes the pipe or the time limit ends first.
ReadOutcome read_answer(int fd, double time_limit_s, std::vector<double>& answer) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(time_limit_s);
  std::size_t received = 0;
  const std::size_t wanted = answer.size() * sizeof(double);
  while (received < wanted) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return ReadOutcome::kTimeout;
    pollfd poller{fd, POLLIN, 0};
    const int ready = ::poll(&poller, 1, static_cast<int>(left));
    if (ready < 0 && errno != EINTR) return ReadOutcome::kEnded;
    if (ready <= 0) continue;
    const ssize_t count = ::read(fd, reinterpret_cast<char*>(answer.data()) + received, wanted - received);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return ReadOutcome::kEnded;
    received += static_cast<std::size_t>(count);
  }
  return ReadOutcome::kWhole;
}

SdpResult failure(SdpStatus status, const std::string& explanation) {
  SdpResult result;
  result.status = status;
  result.explanation = explanation;
  return result;
}

// Combines the solver's verdict with the violation and the gap of its point.
SdpResult judge(const LmiProblem& problem, const SdpOptions& options, const std::vector<double>& answer) {
  SdpResult result;
  const auto phase = static_cast<SdpaPhase>(static_cast<int>(answer[0]));
  result.iterations = static_cast<int>(answer[1]);
  result.unknowns = Eigen::VectorXd::Map(answer.data() + kSdpaHeader, problem.unknown_count());
  const double* next = answer.data() + kSdpaHeader + problem.unknown_count();
  for (const AffineMatrix& inequality : problem.inequalities()) {
    result.duals.emplace_back(Eigen::MatrixXd::Map(next, inequality.rows(), inequality.rows()));
    next += inequality.rows() * inequality.rows();
  }
  result.violation = problem.violation(result.unknowns);
  result.objective = problem.objective().at(result.unknowns)(0, 0);
  const double gap = answer[2];
  const bool feasible = result.violation <= options.tolerance;
  const bool close = gap <= options.accepted_gap;
  if (phase == SdpaPhase::kInfeasible) {
    result.status = SdpStatus::kInaccurate;
    result.explanation = "the solver found no solution";
  } else if (phase == SdpaPhase::kUnbounded) {
    result.status = SdpStatus::kUnbounded;
    result.explanation = "the objective has no lower bound";
  } else if (feasible && close) {
    result.status = SdpStatus::kSolved;
    result.explanation = "solved";
  } else {
    result.status = SdpStatus::kInaccurate;
    result.explanation = "the solver stopped with gap " + std::to_string(gap) + " and violation " +
                         std::to_string(result.violation);
  }
  return result;
}

// The nearest positive semidefinite matrix.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (matrix + matrix.transpose()));
  const Eigen::VectorXd eigenvalues = solver.eigenvalues().cwiseMax(0.0);
  return solver.eigenvectors() * eigenvalues.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

double infeasibility_bound(const LmiProblem& problem, const SdpOptions& options) {
  LmiProblem relaxed = problem;
  const AffineMatrix t = relaxed.relax();
  relaxed.minimise(t);
  const SdpResult result = solve_sdp(relaxed, options);
  double constant = 0.0;
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(problem.unknown_count());
  for (std::size_t b = 0; b < result.duals.size() && b < problem.inequalities().size(); ++b) {
    if (!result.duals[b].allFinite()) return 0.0;
    const Eigen::MatrixXd Y = positive_part(result.duals[b]);
    const AffineMatrix& inequality = problem.inequalities()[b];
    constant += Y.cwiseProduct(inequality.constant()).sum();
    for (const auto& [unknown, coefficient] : inequality.coefficients())
      slopes(unknown) += Y.cwiseProduct(coefficient).sum();
  }
  if (!(constant < 0.0)) return 0.0;
  return -constant / slopes.cwiseAbs().maxCoeff();
}

SdpResult solve_sdp(const LmiProblem& problem, const SdpOptions& options) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return failure(SdpStatus::kCrashed, std::string("no pipe: ") + std::generic_category().message(errno));
  UniqueFd read_end(ends[0]);
  UniqueFd write_end(ends[1]);
  const pid_t child = ::fork();
  if (child < 0)
    return failure(SdpStatus::kCrashed,
                   std::string("no process for the solver: ") + std::generic_category().message(errno));
  if (child == 0) {
    read_end.reset();
    run_child(problem, options, write_end.get());
  }
  write_end.reset();
  std::vector<double> answer(sdpa_answer_size(problem));
  const ReadOutcome outcome = read_answer(read_end.get(), options.time_limit_s, answer);
  if (outcome != ReadOutcome::kWhole) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (outcome == ReadOutcome::kTimeout)
    return failure(SdpStatus::kTimeout, "the solver took too long and was stopped");
  if (outcome == ReadOutcome::kEnded)
    return failure(SdpStatus::kCrashed, "the solver gave up without a result");
  return judge(problem, options, answer);
}

}  // namespace strainwave
