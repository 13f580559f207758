#include "design/controller_lmi.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// The problem in z, x = S z, with the cost divided by `cost_unit` and the torque by `input_unit`.
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

LmiProblem build(const ControllerProblem& problem, Unknowns& unknowns) {
  LmiProblem lmi;
  const Eigen::Index n = problem.state_weights.size();
  const std::size_t rules = problem.A.size();
  const std::size_t gains = problem.scheduled ? rules : 1;
  const Eigen::MatrixXd root_W = problem.state_weights.cwiseSqrt().asDiagonal();
  const double root_R = std::sqrt(problem.input_weight);
  const double inverse_rate = 1.0 / problem.decay_rate;

  unknowns.lambda = lmi.scalar();
  AffineMatrix lambda_I(n, n);
  for (Eigen::Index i = 0; i < n; ++i) lambda_I.add_block(i, i, unknowns.lambda);
  for (std::size_t j = 0; j < gains; ++j) {
    unknowns.Q.push_back(lmi.symmetric(n));
    unknowns.G.push_back(lmi.matrix(n, n));
    unknowns.M.push_back(lmi.matrix(1, n));
    require_bounds(lmi, problem, unknowns.Q[j], unknowns.G[j], unknowns.M[j]);
  }
  for (std::size_t j = 0; j < rules; ++j) {
    const std::size_t own = problem.scheduled ? j : 0;
    const AffineMatrix& Q = unknowns.Q[own];
    const AffineMatrix& G = unknowns.G[own];
    const AffineMatrix& M = unknowns.M[own];
    const AffineMatrix next = inverse_rate * (problem.A[j] * G + Eigen::MatrixXd(problem.B[j]) * M);
    for (std::size_t l = 0; l < gains; ++l) {
      lmi.require_positive(symmetric_blocks({{G + G.transpose() - Q},     //
                                             {next, unknowns.Q[l]},       //
                                             {root_W * G, {}, lambda_I},  //
                                             {root_R * M, {}, {}, unknowns.lambda}}));
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

// S = diag(P)^(-1/2), with the largest diagonal over the rules. False when P is not usable.
bool rebalance(const ControllerSolution& solution, Units& units) {
  if (solution.P.empty() || !(solution.lambda > 0.0) || !std::isfinite(solution.lambda)) return false;
  Eigen::VectorXd diagonal = solution.P.front().diagonal();
  for (const Eigen::MatrixXd& P : solution.P) diagonal = diagonal.cwiseMax(P.diagonal());
  if (!diagonal.allFinite() || !(diagonal.minCoeff() > 0.0)) return false;
  units.cost = solution.lambda;
  units.state = (diagonal / solution.lambda).cwiseInverse().cwiseSqrt();
  return true;
}

}  // namespace

ControllerSolution solve_controller(const ControllerProblem& problem, const SdpOptions& options) {
  Units units;
  // lambda is at least the cost of the first sample.
  units.cost = 0.0;
  for (const Eigen::VectorXd& v : problem.initial_states) {
    units.cost = std::max(units.cost, v.dot(problem.state_weights.asDiagonal() * v));
  }
  units.state = (problem.state_weights / units.cost).cwiseInverse().cwiseSqrt();
  units.input =
      problem.input_limit > 0.0 ? problem.input_limit : std::sqrt(units.cost / problem.input_weight);
  ControllerSolution first = solve_in_units(problem, units, options);
  if (first.status == SdpStatus::kInfeasible || first.status == SdpStatus::kUnbounded) return first;
  if (!rebalance(first, units)) return first;
  return solve_in_units(problem, units, options);
}

}  // namespace strainwave
