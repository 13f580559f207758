// SPDX-License-Identifier: BSD-3-Clause
// Theorems 2 and 3: the bounds on torque and outputs hold from every vertex of the box of initial states.
#include <gtest/gtest.h>

#include "design/gains/controller_lmi.h"
#include "tests/design/gains/worst_case.h"
#include "tests/design/reference_case.h"

namespace strainwave {
namespace {

DesignRequest boxed_request() {
  DesignRequest request = reference_request();
  request.initial_states = box_vertices(StateVector(0.002, 0.02, 0.1));
  return request;
}

WorstCase worst_of_all_vertices(const FeedbackGains& gains, const DesignRequest& request) {
  std::mt19937_64 random(1);
  WorstCase worst;
  for (const StateVector& vertex : request.initial_states) {
    for (int run = 0; run < 10; ++run) {
      StateVector start = vertex;
      if (!gains.has_integrator) start(0) = 0.0;
      const WorstCase trajectory = simulate_worst_case(gains, request, start, 2000, random);
      EXPECT_LE(trajectory.cost, gains.cost_bound);
      worst.largest_torque_Nm = std::max(worst.largest_torque_Nm, trajectory.largest_torque_Nm);
      worst.largest = worst.largest.cwiseMax(trajectory.largest);
    }
  }
  return worst;
}

TEST(ControllerBounds, TheTorqueBoundHoldsFromEveryVertexAndCostsSomething) {
  DesignRequest request = boxed_request();
  for (const Controller controller : kAllControllers) {
    request.max_torque_Nm.reset();
    const DesignedGains free = design_gains(controller, request);
    ASSERT_GT(worst_of_all_vertices(free.gains, request).largest_torque_Nm, 12.0)
        << "the bound would not bind";
    request.max_torque_Nm = 12.0;
    const DesignedGains bounded = design_gains(controller, request);
    EXPECT_TRUE(bounded.bounds_hold);
    EXPECT_LE(worst_of_all_vertices(bounded.gains, request).largest_torque_Nm, 12.0) << name_of(controller);
    EXPECT_GT(bounded.lambda, free.lambda);
  }
}

TEST(ControllerBounds, ThePositionBoundHoldsFromEveryVertex) {
  DesignRequest request = boxed_request();
  request.initial_states = box_vertices(StateVector(0.0, 0.02, 0.3));
  for (const Controller controller : kAllControllers) {
    request.max_position_rad.reset();
    const double free_lambda = design_gains(controller, request).lambda;
    request.max_position_rad = 0.024;
    const DesignedGains bounded = design_gains(controller, request);
    EXPECT_GT(bounded.lambda, free_lambda) << "the bound does not bind";
    EXPECT_TRUE(bounded.bounds_hold);
    EXPECT_LE(worst_of_all_vertices(bounded.gains, request).largest(1), 0.024) << name_of(controller);
  }
}

TEST(ControllerBounds, TheVelocityBoundHoldsFromEveryVertex) {
  DesignRequest request = boxed_request();
  request.max_velocity_rad_s = 0.5;
  const DesignedGains bounded = design_gains(Controller::kC4, request);
  EXPECT_LE(worst_of_all_vertices(bounded.gains, request).largest(2), 0.5);
}

TEST(ControllerBounds, LessTorqueNeverCostsLess) {
  DesignRequest request = boxed_request();
  double previous = 0.0;
  for (const double limit : {20.0, 14.0, 11.0, 9.0}) {
    request.max_torque_Nm = limit;
    const double lambda = solve_gains(Controller::kC4, request).lambda;
    EXPECT_GE(lambda, previous * (1.0 - 1e-6)) << limit;
    previous = lambda;
  }
}

// The paper's form fixes mu and minimises lambda, with the bound mu^2 lambda. A limit in N.m then needs a search over mu. It is repeated here as an
// independent check of controller_lmi.h, which needs no search.
double lambda_of_mu(const ControllerProblem& problem, double mu) {
  LmiProblem lmi;
  const AffineMatrix lambda = lmi.scalar(), Q = lmi.symmetric(2), G = lmi.matrix(2, 2), M = lmi.matrix(1, 2);
  const auto constant = [](const Eigen::MatrixXd& matrix) { return AffineMatrix(matrix); };
  for (const Eigen::VectorXd& v : problem.initial_states) {
    lmi.require_positive(symmetric_blocks({{lambda}, {Eigen::MatrixXd(v), Q}}));
  }
  const Eigen::MatrixXd root_W = problem.state_weights.cwiseSqrt().asDiagonal();
  for (std::size_t j = 0; j < problem.A.size(); ++j) {
    lmi.require_positive(symmetric_blocks(
        {{G + G.transpose() - Q},
         {problem.A[j] * G + Eigen::MatrixXd(problem.B[j]) * M, Q},
         {root_W * G, {}, constant(Eigen::Matrix2d::Identity())},
         {std::sqrt(problem.input_weight) * M, {}, {}, constant(Eigen::MatrixXd::Ones(1, 1))}}));
  }
  lmi.require_positive(
      symmetric_blocks({{G + G.transpose() - Q}, {M, constant(Eigen::MatrixXd::Constant(1, 1, mu * mu))}}));
  lmi.minimise(lambda);
  const SdpResult result = solve_sdp(lmi);
  EXPECT_TRUE(result.status == SdpStatus::kSolved || result.status == SdpStatus::kInaccurate)
      << result.explanation;
  return result.objective;
}

TEST(ControllerBounds, OneSolveGivesWhatTheSearchOverMuConvergesTo) {
  // A double integrator in units near one, so that the solver also handles the unbalanced form well.
  ControllerProblem problem;
  for (const double viscous : {0.0, 0.3}) {
    Eigen::Matrix2d A;
    A << 1.0, 0.1, 0.0, 1.0 - 0.1 * viscous;
    problem.A.push_back(A);
    problem.B.push_back(Eigen::Vector2d(0.0, 0.1));
  }
  problem.state_weights = Eigen::Vector2d(1.0, 0.1);
  problem.input_weight = 0.1;
  problem.initial_states = {Eigen::Vector2d(1.0, 0.0)};
  problem.scheduled = false;
  problem.input_limit = 1.2;
  const ControllerSolution solution = solve_controller(problem);
  ASSERT_EQ(solution.status, SdpStatus::kSolved) << solution.explanation;
  // lambda falls with mu, and mu^2 lambda = limit^2 at the optimum, so the test bisects.
  double low = 0.05, high = 5.0;
  for (int i = 0; i < 40; ++i) {
    const double mu = 0.5 * (low + high);
    (mu * mu * lambda_of_mu(problem, mu) <= problem.input_limit * problem.input_limit ? low : high) = mu;
  }
  EXPECT_NEAR(lambda_of_mu(problem, low), solution.lambda, 1e-4 * solution.lambda);
  EXPECT_NEAR(low * low * solution.lambda, problem.input_limit * problem.input_limit, 1e-2);
}

}  // namespace
}  // namespace strainwave
