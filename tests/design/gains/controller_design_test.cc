// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/controller_design.h"

#include <gtest/gtest.h>

#include <random>

#include "control/table/gain_table_json.h"
#include "design/gains/controller_lmi.h"
#include "tests/design/gains/worst_case.h"
#include "tests/design/reference_case.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::string message_of(Controller controller, const DesignRequest& request) {
  return testing::refusal_of([&] { design_gains(controller, request); });
}

// docs/theory.md, section 7, without the margin. The cost is 18.37144. Gains within 1e-3 of these change it by less than 1e-6 relative, so the
// optimum does not determine the last digit of a gain.
TEST(ControllerDesign, GivesTheReferenceCase) {
  DesignRequest request = reference_request();
  request.sampling = Sampling::kForwardEuler;
  request.margin = 0.0;
  const DesignedGains designed = solve_gains(Controller::kC4, request);
  EXPECT_NEAR(designed.lambda, 18.3714, 2e-4);
  EXPECT_LE(designed.violation, 1e-9);
  EXPECT_NEAR(designed.gains.gain(0)(0), -304.2, 0.3);
  EXPECT_NEAR(designed.gains.gain(0)(1), -967.7, 0.7);
  EXPECT_NEAR(designed.gains.gain(0)(2), -16.63, 0.005);
}

TEST(ControllerDesign, CertifiesAllFourControllersAtTheNominalWeights) {
  const DesignRequest request = reference_request();
  for (const Controller controller : kAllControllers) {
    const DesignedGains designed = design_gains(controller, request);
    EXPECT_TRUE(designed.certificate.certified) << name_of(controller);
    EXPECT_EQ(designed.gains.weights.position, request.weights.position);
    EXPECT_EQ(designed.gains.weights.integral, has_integrator(controller) ? request.weights.integral : 0.0);
  }
}

TEST(ControllerDesign, SchedulingNeverCostsMoreThanOneGain) {
  const DesignRequest request = reference_request();
  EXPECT_LT(solve_gains(Controller::kC4, request).lambda, solve_gains(Controller::kC3, request).lambda);
  EXPECT_LT(solve_gains(Controller::kC2, request).lambda, solve_gains(Controller::kC1, request).lambda);
}

TEST(ControllerDesign, TheCostBoundCoversWorstCaseSimulations) {
  std::mt19937_64 random(1);
  const DesignRequest request = reference_request();
  for (const Controller controller : kAllControllers) {
    const FeedbackGains gains = design_gains(controller, request).gains;
    for (int run = 0; run < 20; ++run) {
      const WorstCase trajectory =
          simulate_worst_case(gains, request, request.initial_states[0], 3000, random);
      EXPECT_LE(trajectory.cost, gains.cost_bound) << name_of(controller);
      EXPECT_GT(trajectory.cost, 0.5 * gains.cost_bound) << "the bound says nothing";
    }
  }
}

TEST(ControllerDesign, RegeneratesTheTablesOfTheSource) {
  DesignRequest request = reference_request();
  request.sampling = Sampling::kForwardEuler;
  for (const auto& [file, controller] :
       {std::pair("c1", Controller::kC1), std::pair("c2", Controller::kC2), std::pair("c3", Controller::kC3),
        std::pair("c4", Controller::kC4)}) {
    const GainTable shipped =
        read_gain_table(std::string(STRAINWAVE_SOURCE_DIR "/data/tables/") + file + ".json");
    const FeedbackGains gains = design_gains(controller, request).gains;
    ASSERT_EQ(gains.rule_count, shipped.primary.rule_count);
    for (int j = 0; j < gains.rule_count; ++j) {
      EXPECT_TRUE(gains.gain(j).isApprox(shipped.primary.gain(j), 1e-6)) << file << " rule " << j;
    }
  }
}

TEST(ControllerDesign, IsCertifiedAsSampledAndHeldForEveryMistake) {
  const DesignRequest request = reference_request();
  for (const Controller controller : kAllControllers) {
    const FeedbackGains gains = design_gains(controller, request).gains;
    const CertificateReport held = certify(gains, request.plant, request.friction);
    EXPECT_TRUE(held.certified) << name_of(controller);
    EXPECT_EQ(held.inequalities, is_scheduled(controller) ? 306 : 6);
  }
}

// Friction brakes this joint within a period. Gains designed only for the correct rules fail with mistaken rules.
TEST(ControllerDesign, AsksForMistakenRulesWhereTheyFail) {
  DesignRequest request = reference_request();
  request.plant.inertia_kgm2 = 0.001;
  const DesignedGains first = solve_gains(Controller::kC4, request);
  EXPECT_FALSE(first.certificate.certified);
  EXPECT_NE(first.certificate.worst.kind, Inequality::kPair);
  EXPECT_TRUE(design_gains(Controller::kC4, request).certificate.certified);
}

// An earlier solve in unsuitable units reported "no solution exists" for each of these problems.
TEST(ControllerDesign, SolvesWhatHasASolution) {
  const std::vector<std::function<void(DesignRequest&)>> changes{
      [](auto& r) { r.plant.inertia_kgm2 = 50.0; },
      [](auto& r) { r.plant.inertia_kgm2 = 1000.0; },
      [](auto& r) { r.plant.inertia_kgm2 = 5.0, r.plant.period_s = 5e-4; },
      [](auto& r) { r.initial_states = {StateVector(1.0, 0.0, 0.0)}; },
      [](auto& r) { r.decay_rate = 0.99; },
      [](auto& r) { r.weights.torque = 1e-3, r.plant.inertia_kgm2 = 0.389; },
      [](auto& r) { r.max_torque_Nm = 0.1, r.initial_states = {StateVector(0.0, 0.01, 0.0)}; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    DesignRequest request = reference_request();
    changes[i](request);
    EXPECT_EQ(message_of(Controller::kC4, request), "accepted") << i;
  }
  DesignRequest heavy = reference_request();
  heavy.plant.inertia_kgm2 = 50.0;
  heavy.sampling = Sampling::kForwardEuler;
  EXPECT_NEAR(solve_gains(Controller::kC4, heavy).lambda, 354.860, 0.01);
}

TEST(ControllerDesign, ADecayRateIsKeptBySimulations) {
  std::mt19937_64 random(2);
  DesignRequest request = reference_request();
  request.decay_rate = 0.999;
  const FeedbackGains gains = design_gains(Controller::kC4, request).gains;
  const int samples = 5000;
  const WorstCase trajectory =
      simulate_worst_case(gains, request, request.initial_states[0], samples, random);
  // |x|^2 falls with V, up to the condition of P.
  EXPECT_LT(trajectory.final_ratio, 1e4 * std::pow(request.decay_rate, samples));
}

// The same plant with other units of its states must give the same cost and the same feedback.
TEST(ControllerDesign, TheUnitsOfTheStatesDoNotMatter) {
  const DesignRequest request = reference_request();
  ControllerProblem problem;
  for (int j = 0; j < plant_rule_count(request.friction); ++j) {
    const SampledDynamics dynamics =
        sampled_dynamics(request.plant, plant_rule_viscous_Nms_rad(request.friction, j), true);
    problem.A.push_back(dynamics.A);
    problem.B.push_back(dynamics.B);
  }
  problem.state_weights = StateVector(0.101, 1.01, 1.01e-4);
  problem.input_weight = 1.01e-6;
  problem.initial_states = {StateVector(0.0, 1.0, 0.0)};
  const ControllerSolution plain = solve_controller(problem);
  ASSERT_EQ(plain.status, SdpStatus::kSolved);

  const StateVector unit(1e3, 180.0 / 3.14159265, 1e-4);  // x_new = unit x
  const double torque_unit = 1e3, cost_unit = 1e5;
  ControllerProblem other = problem;
  for (Eigen::MatrixXd& A : other.A) A = unit.asDiagonal() * A * unit.cwiseInverse().asDiagonal();
  for (Eigen::VectorXd& B : other.B) B = unit.asDiagonal() * B / torque_unit;
  for (Eigen::VectorXd& v : other.initial_states) v = unit.asDiagonal() * v;
  other.state_weights = cost_unit * problem.state_weights.array() / unit.array().square();
  other.input_weight = cost_unit * problem.input_weight / (torque_unit * torque_unit);
  const ControllerSolution scaled = solve_controller(other);
  ASSERT_EQ(scaled.status, SdpStatus::kSolved);
  EXPECT_NEAR(scaled.lambda / cost_unit, plain.lambda, 1e-6 * plain.lambda);
  for (std::size_t j = 0; j < plain.F.size(); ++j) {
    const Eigen::RowVectorXd back = scaled.F[j] * unit.asDiagonal() / torque_unit;
    EXPECT_TRUE(back.isApprox(plain.F[j], 1e-6)) << back << " against " << plain.F[j];
  }
}

TEST(ControllerDesign, CallsImpossibleWhatIsProvedToBe) {
  DesignRequest request = reference_request();
  request.max_position_rad = 0.5;  // the initial state is already outside
  const std::string proved = message_of(Controller::kC4, request);
  EXPECT_NE(proved.find("no C4 exists"), std::string::npos) << proved;
  EXPECT_NE(proved.find("--max-position_rad"), std::string::npos) << proved;
}

// Any torque brings a joint without a load back, if slowly. A solution exists, but the solver does not find it.
TEST(ControllerDesign, SaysThatTheSolverFailedWhereNothingIsProved) {
  DesignRequest request = reference_request();
  request.max_torque_Nm = 1e-3;
  const std::string failed = message_of(Controller::kC4, request);
  EXPECT_NE(failed.find("the solver failed on C4"), std::string::npos) << failed;
  EXPECT_NE(failed.find("--max-torque_Nm"), std::string::npos) << failed;
}

TEST(ControllerDesign, AJointTooLightForForwardEulerIsToldOfTheHold) {
  DesignRequest request = reference_request();
  request.plant.inertia_kgm2 = 0.001;
  request.sampling = Sampling::kForwardEuler;
  const std::string failed = message_of(Controller::kC4, request);
  EXPECT_NE(failed.find("--sampling zoh"), std::string::npos) << failed;
}

TEST(ControllerDesign, BadFieldsAreNamed) {
  const auto with = [](const std::function<void(DesignRequest&)>& change) {
    DesignRequest request = reference_request();
    change(request);
    return message_of(Controller::kC4, request);
  };
  EXPECT_NE(with([](auto& r) { r.plant.period_s = 0.0; }).find("period_s"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.plant.period_s = std::nan(""); }).find("period_s"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.plant.inertia_kgm2 = -1.0; }).find("inertia_kgm2"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.weights.position = 0.0; }).find("weights position"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.weights.torque = -1e-6; }).find("weights torque"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.margin = -0.1; }).find("margin"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.decay_rate = 1.5; }).find("decay_rate"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.initial_states = {StateVector::Zero()}; }).find("x0"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.initial_states[0](1) = std::nan(""); }).find("x0"), std::string::npos);
  EXPECT_NE(with([](auto& r) { r.max_torque_Nm = -3.0; }).find("max_torque_Nm"), std::string::npos);
}

TEST(ControllerDesign, BoxVerticesAreHalfTheCorners) {
  EXPECT_EQ(box_vertices(StateVector(1.0, 2.0, 3.0)).size(), 4u);
  EXPECT_EQ(box_vertices(StateVector(0.0, 2.0, 3.0)).size(), 2u);
  EXPECT_EQ(box_vertices(StateVector(0.0, 2.0, 0.0)).size(), 1u);
}

}  // namespace
}  // namespace strainwave
