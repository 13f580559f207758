// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/controller_lmi.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "control/joint/riccati.h"

namespace strainwave {

namespace {

// Units of the solved problem: x = S z, the cost divided by `cost`, the torque by `input`.
struct Units {
  Eigen::VectorXd state;  // diagonal of S
  double cost = 1.0;
  double input = 1.0;
};

ControllerProblem in_units(const ControllerProblem& problem, const Units& units) {
  ControllerProblem scaled = problem;
  const Eigen::VectorXd& S = units.state;
  const Eigen::VectorXd inverse = S.cwiseInverse();
  for (Eigen::MatrixXd& A : scaled.A) A = inverse.asDiagonal() * A * S.asDiagonal();
  for (Eigen::VectorXd& B : scaled.B) B = inverse.asDiagonal() * B * units.input;
  for (Eigen::VectorXd& v : scaled.initial_states) v = inverse.asDiagonal() * v;
  scaled.state_weights = problem.state_weights.array() * S.array().square() / units.cost;
  scaled.input_weight = problem.input_weight * units.input * units.input / units.cost;
  scaled.input_limit = problem.input_limit / units.input;
  for (OutputBound& bound : scaled.output_bounds) {
    bound.row = bound.row * S.asDiagonal() / bound.limit;
    bound.limit = 1.0;
  }
  return scaled;
}

void out_of_units(ControllerSolution& solution, const Units& units) {
  const Eigen::VectorXd inverse = units.state.cwiseInverse();
  solution.lambda *= units.cost;
  for (Eigen::RowVectorXd& F : solution.F) F = units.input * F * inverse.asDiagonal();
  for (Eigen::MatrixXd& P : solution.P) {
    const Eigen::MatrixXd in_state_units = units.cost * (inverse.asDiagonal() * P * inverse.asDiagonal());
    P = 0.5 * (in_state_units + in_state_units.transpose());
  }
}

struct Unknowns {
  AffineMatrix lambda;
  std::vector<AffineMatrix> Q, G, M;
};

void require_bounds(LmiProblem& lmi, const ControllerProblem& problem, const AffineMatrix& Q,
                    const AffineMatrix& G, const AffineMatrix& M) {
  const auto square = [](double limit) {
    return AffineMatrix(Eigen::MatrixXd::Constant(1, 1, limit * limit));
  };
  for (const Eigen::VectorXd& v : problem.initial_states) {
    lmi.require_positive(symmetric_blocks({{square(1.0)}, {Eigen::MatrixXd(v), Q}}));
  }
  const AffineMatrix corner = G + G.transpose() - Q;
  if (problem.input_limit > 0.0)
    lmi.require_positive(symmetric_blocks({{corner}, {M, square(problem.input_limit)}}));
  for (const OutputBound& bound : problem.output_bounds) {
    lmi.require_positive(symmetric_blocks({{corner}, {Eigen::MatrixXd(bound.row) * G, square(bound.limit)}}));
  }
}

// On plant rule i, V falls by `share` of the stage cost from gain rule j to every next gain rule.
void require_decrease(LmiProblem& lmi, const ControllerProblem& problem, const Unknowns& unknowns,
                      std::size_t i, std::size_t j, double share) {
  const Eigen::Index n = problem.state_weights.size();
  const Eigen::MatrixXd root_W = (share * problem.state_weights).cwiseSqrt().asDiagonal();
  const double root_R = std::sqrt(share * problem.input_weight);
  AffineMatrix lambda_I(n, n);
  for (Eigen::Index a = 0; a < n; ++a) lambda_I.add_block(a, a, unknowns.lambda);
  const AffineMatrix& G = unknowns.G[j];
  const AffineMatrix& M = unknowns.M[j];
  const AffineMatrix next =
      (1.0 / problem.decay_rate) * (problem.A[i] * G + Eigen::MatrixXd(problem.B[i]) * M);
  for (const AffineMatrix& Q_next : unknowns.Q) {
    lmi.require_positive(symmetric_blocks({{G + G.transpose() - unknowns.Q[j]},  //
                                           {next, Q_next},                       //
                                           {root_W * G, {}, lambda_I},           //
                                           {root_R * M, {}, {}, unknowns.lambda}}));
  }
}

LmiProblem build(const ControllerProblem& problem, Unknowns& unknowns) {
  LmiProblem lmi;
  const Eigen::Index n = problem.state_weights.size();
  const std::size_t rules = problem.A.size();
  unknowns.lambda = lmi.scalar();
  for (std::size_t j = 0; j < (problem.scheduled ? rules : 1); ++j) {
    unknowns.Q.push_back(lmi.symmetric(n));
    unknowns.G.push_back(lmi.matrix(n, n));
    unknowns.M.push_back(lmi.matrix(1, n));
    require_bounds(lmi, problem, unknowns.Q[j], unknowns.G[j], unknowns.M[j]);
  }
  for (std::size_t i = 0; i < rules; ++i) {
    for (std::size_t j = 0; j < unknowns.Q.size(); ++j) {
      const bool own = !problem.scheduled || i == j;
      const double share = own ? 1.0 : problem.mistaken_share;
      if (share > 0.0) require_decrease(lmi, problem, unknowns, i, j, share);
    }
  }
  lmi.minimise(unknowns.lambda);
  return lmi;
}

ControllerSolution solve_in_units(const ControllerProblem& problem, const Units& units,
                                  const SdpOptions& options) {
  Unknowns unknowns;
  const LmiProblem lmi = build(in_units(problem, units), unknowns);
  const SdpResult result = solve_sdp(lmi, options);
  ControllerSolution solution;
  solution.status = result.status;
  solution.explanation = result.explanation;
  solution.violation = result.violation;
  if (result.unknowns.size() == 0) return solution;
  solution.lambda = unknowns.lambda.at(result.unknowns)(0, 0);
  for (std::size_t j = 0; j < unknowns.Q.size(); ++j) {
    const Eigen::MatrixXd G = unknowns.G[j].at(result.unknowns);
    solution.F.push_back(unknowns.M[j].at(result.unknowns) * G.inverse());
    solution.P.push_back(solution.lambda * unknowns.Q[j].at(result.unknowns).inverse());
  }
  out_of_units(solution, units);
  return solution;
}

// Sets S = diag(P / cost)^(-1/2) and the cost's unit. Returns false if they are not positive and finite.
bool balance(const Eigen::VectorXd& diagonal, double cost, Units& units) {
  if (!(cost > 0.0) || !std::isfinite(cost)) return false;
  if (!diagonal.allFinite() || !(diagonal.minCoeff() > 0.0)) return false;
  units.cost = cost;
  units.state = (diagonal / cost).cwiseInverse().cwiseSqrt();
  return true;
}

// Balances by the largest diagonal entries over the rules.
bool rebalance(const ControllerSolution& solution, Units& units) {
  if (solution.P.empty()) return false;
  Eigen::VectorXd diagonal = solution.P.front().diagonal();
  for (const Eigen::MatrixXd& P : solution.P) diagonal = diagonal.cwiseMax(P.diagonal());
  return balance(diagonal, solution.lambda, units);
}

double largest_cost(const ControllerProblem& problem, const Eigen::MatrixXd& P) {
  double largest = 0.0;
  for (const Eigen::VectorXd& v : problem.initial_states) largest = std::max(largest, v.dot(P * v));
  return largest;
}

// Units from the Riccati cost of one rule without limits, or from the weights if that has no solution.
Units first_units(const ControllerProblem& problem) {
  const std::size_t middle = problem.A.size() / 2;
  const double rate = problem.decay_rate;
  const auto riccati = solve_riccati(problem.A[middle] / rate, problem.B[middle] / rate,
                                     problem.state_weights, problem.input_weight);
  Units units;
  if (!riccati || !balance(riccati->diagonal(), largest_cost(problem, *riccati), units))
    balance(problem.state_weights, largest_cost(problem, problem.state_weights.asDiagonal()), units);
  units.input =
      problem.input_limit > 0.0 ? problem.input_limit : std::sqrt(units.cost / problem.input_weight);
  return units;
}

}  // namespace

ControllerSolution solve_controller(const ControllerProblem& problem, const SdpOptions& options) {
  const Units first_guess = first_units(problem);
  ControllerSolution solution = solve_in_units(problem, first_guess, options);
  Units units = first_guess;
  if (rebalance(solution, units)) {
    ControllerSolution second = solve_in_units(problem, units, options);
    if (second.status == SdpStatus::kSolved || solution.status != SdpStatus::kSolved)
      solution = std::move(second);
  }
  if (solution.status == SdpStatus::kSolved) return solution;
  Unknowns unknowns;
  const LmiProblem lmi = build(in_units(problem, first_guess), unknowns);
  solution.impossible = infeasibility_bound(lmi, options) >= kProvedSize;
  return solution;
}

}  // namespace strainwave
