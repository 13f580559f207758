// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/sdp_solver.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

namespace strainwave {
namespace {

Eigen::MatrixXd constant(double value) {
  return Eigen::MatrixXd::Constant(1, 1, value);
}

TEST(SdpSolver, FindsAKnownOptimum) {
  // minimise x + y with [x 1; 1 y] >= 0: x = y = 1.
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar();
  const AffineMatrix y = lmi.scalar();
  lmi.require_positive(symmetric_blocks({{x}, {constant(1.0), y}}));
  lmi.minimise(x + y);
  const SdpResult result = solve_sdp(lmi);
  ASSERT_EQ(result.status, SdpStatus::kSolved) << result.explanation;
  EXPECT_NEAR(result.objective, 2.0, 1e-6);
  EXPECT_NEAR(result.unknowns(0), 1.0, 1e-3);
  EXPECT_LE(result.violation, 1e-7);
}

TEST(SdpSolver, ProvesNothingOfAProblemThatHasASolution) {
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar(), y = lmi.scalar();
  lmi.require_positive(x + constant(-50.0));  // x >= 50
  lmi.require_positive(symmetric_blocks({{x}, {constant(1.0), y}}));
  lmi.minimise(y);
  EXPECT_LE(infeasibility_bound(lmi), 51.0);
}

TEST(SdpSolver, ProvesThatAProblemIsInfeasible) {
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar();
  lmi.require_positive(x + constant(-2.0));        // x >= 2
  lmi.require_positive(-1.0 * x + constant(1.0));  // x <= 1
  lmi.minimise(x);
  EXPECT_NE(solve_sdp(lmi).status, SdpStatus::kSolved);
  EXPECT_GT(infeasibility_bound(lmi), 1e6);
}

TEST(SdpSolver, SaysThatAProblemIsUnbounded) {
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar();
  lmi.require_positive(-1.0 * x);
  lmi.minimise(x);
  EXPECT_EQ(solve_sdp(lmi).status, SdpStatus::kUnbounded);
}

TEST(SdpSolver, ASolverThatDiesIsAResultAndLeavesNoProcess) {
  // An unknown that occurs nowhere makes SDPA's normal equations singular. A problem without unknowns makes SDPA give up.
  LmiProblem lmi;
  lmi.require_positive(Eigen::MatrixXd(Eigen::MatrixXd::Identity(2, 2)));
  const SdpResult result = solve_sdp(lmi);
  EXPECT_NE(result.status, SdpStatus::kSolved);
  EXPECT_FALSE(result.explanation.empty());
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(SdpSolver, ATimeLimitEndsTheSolver) {
  LmiProblem lmi;
  const AffineMatrix X = lmi.symmetric(40);  // 820 unknowns: seconds of work
  lmi.require_positive(X + Eigen::MatrixXd(-Eigen::MatrixXd::Identity(40, 40)));
  for (int i = 0; i < 20; ++i)
    lmi.require_positive(X +
                         Eigen::MatrixXd(Eigen::MatrixXd::Random(40, 40).selfadjointView<Eigen::Upper>()));
  AffineMatrix trace(1, 1);
  for (const auto& [unknown, coefficient] : X.coefficients())
    trace.add_term(unknown, constant(coefficient.trace()));
  lmi.minimise(trace);
  SdpOptions options;
  options.time_limit_s = 0.02;
  EXPECT_EQ(solve_sdp(lmi, options).status, SdpStatus::kTimeout);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(SdpSolver, ItsOutputStaysOutOfOurs) {
  LmiProblem lmi;
  const AffineMatrix x = lmi.scalar();
  lmi.require_positive(x);
  lmi.minimise(x);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  solve_sdp(lmi);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace strainwave
