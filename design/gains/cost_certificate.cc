// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/cost_certificate.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

#include "control/table/bounded_matrix.h"

namespace strainwave {

namespace {

// A controller without an integrator omits the first state.
struct Problem {
  const FeedbackGains& gains;
  std::size_t first = 0;
  Eigen::Index n = 0;
  BoundedMatrix W;
  Bounded by_rate;  // 1 / r^2
  std::vector<BoundedMatrix> F;
  std::vector<BoundedMatrix> P;
};

bool fits(const FeedbackGains& gains, std::size_t plant_rules) noexcept {
  if (plant_rules < 2 || plant_rules > kMaxRules) return false;
  if (gains.rule_count != 1 && gains.rule_count != static_cast<int>(plant_rules)) return false;
  if (!(gains.decay_rate > 0.0 && gains.decay_rate <= 1.0) || !(gains.weights.torque >= 0.0)) return false;
  if (!(gains.weights.integral >= 0.0) || !(gains.weights.position >= 0.0) ||
      !(gains.weights.velocity >= 0.0))
    return false;
  if (gains.has_integrator) return true;
  for (int j = 0; j < gains.rule_count; ++j) {
    if (gains.gain(j)(0) != 0.0) return false;
  }
  return true;
}

Problem make_problem(const FeedbackGains& gains) {
  const std::size_t first = gains.has_integrator ? 0 : 1;
  const auto n = static_cast<Eigen::Index>(kMaxStates - first);
  const StateVector weights(gains.weights.integral, gains.weights.position, gains.weights.velocity);
  Problem problem{gains,
                  first,
                  n,
                  BoundedMatrix(ProofMatrix(weights.tail(n).asDiagonal())),
                  Bounded(1.0) / (Bounded(gains.decay_rate) * gains.decay_rate),
                  {},
                  {}};
  for (int j = 0; j < gains.rule_count; ++j) {
    problem.F.emplace_back(ProofMatrix(gains.gain(j).tail(n)));
    problem.P.emplace_back(ProofMatrix(gains.lyapunov(j).bottomRightCorner(n, n)));
  }
  return problem;
}

// A + B F.
BoundedMatrix closed_loop(const Problem& problem, const BoundedDynamics& plant, std::size_t rule) {
  BoundedMatrix H(problem.n, problem.n);
  for (Eigen::Index a = 0; a < problem.n; ++a)
    for (Eigen::Index b = 0; b < problem.n; ++b) {
      const std::size_t row = problem.first + static_cast<std::size_t>(a);
      H.set(a, b,
            plant.A[row][problem.first + static_cast<std::size_t>(b)] +
                plant.B[row] * problem.F[rule].value(0, b));
    }
  return H;
}

// P_j less the stage cost W + F_j' R F_j.
BoundedMatrix less_cost(const Problem& problem, std::size_t j) {
  const Bounded R = problem.gains.weights.torque;
  return problem.P[j] - problem.W - R * (problem.F[j].transpose() * problem.F[j]);
}

PositiveDefiniteResult test(const BoundedMatrix& matrix) {
  return test_positive_definite(matrix.value, matrix.error, static_cast<int>(matrix.value.rows()));
}

// allowed - copies H' P_l H / r^2 > 0.
PositiveDefiniteResult test_step(const Problem& problem, const BoundedMatrix& allowed, double copies,
                                 const BoundedMatrix& H, std::size_t l) {
  return test(allowed - Bounded(copies) * problem.by_rate * (H.transpose() * (problem.P[l] * H)));
}

void keep_worst(CertificateReport& report, const PositiveDefiniteResult& result,
                const WorstInequality& which) noexcept {
  report.certified = report.certified && result.certain;
  if (result.margin < report.worst.margin) {
    report.worst = which;
    report.worst.margin = result.margin;
  }
}

// Tests one rule of the plant under one gain, for every next gain rule.
void test_rule(const Problem& problem, const BoundedDynamics& plant, std::size_t i, std::size_t j,
               CertificateReport& report) {
  const bool own = problem.P.size() == 1 || i == j;
  const BoundedMatrix H = closed_loop(problem, plant, j);
  const BoundedMatrix allowed = own ? less_cost(problem, j) : problem.P[j];
  for (std::size_t l = 0; l < problem.P.size(); ++l) {
    const PositiveDefiniteResult result = test_step(problem, allowed, 1.0, H, l);
    keep_worst(report, result,
               {own ? Inequality::kPair : Inequality::kMistaken, static_cast<int>(i), static_cast<int>(j),
                static_cast<int>(l), 0.0});
    ++report.inequalities;
  }
}

void test_crossed(const Problem& problem, std::span<const BoundedDynamics> plant, std::size_t j,
                  std::size_t k, CertificateReport& report) {
  const BoundedMatrix H =
      Bounded(0.5) * (closed_loop(problem, plant[j], k) + closed_loop(problem, plant[k], j));
  const BoundedMatrix allowed = less_cost(problem, j) + less_cost(problem, k);
  for (std::size_t l = 0; l < problem.P.size(); ++l) {
    keep_worst(report, test_step(problem, allowed, 2.0, H, l),
               {Inequality::kCrossed, static_cast<int>(k), static_cast<int>(j), static_cast<int>(l), 0.0});
    ++report.inequalities;
  }
}

}  // namespace

std::string describe(const WorstInequality& worst) {
  std::ostringstream text;
  text << std::setprecision(3);
  if (std::isfinite(worst.margin)) {
    text << worst.margin;
  } else {
    text << "none (not positive on its diagonal)";
  }
  if (worst.kind == Inequality::kCrossed) {
    text << ", rules " << worst.from << " and " << worst.plant << " blended";
  } else {
    text << ", plant rule " << worst.plant << " under gain rule " << worst.from;
  }
  text << ", to rule " << worst.to;
  return text.str();
}

CertificateReport certify(const FeedbackGains& gains, std::span<const BoundedDynamics> plant_rules) {
  CertificateReport report;
  report.worst.margin = -std::numeric_limits<double>::infinity();
  if (!fits(gains, plant_rules.size())) return report;
  const Problem problem = make_problem(gains);

  report.certified = true;
  report.plant_rules = static_cast<int>(plant_rules.size());
  report.gain_rules = gains.rule_count;
  report.worst.margin = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < problem.P.size(); ++j) {
    const int rule = static_cast<int>(j);
    keep_worst(report, test(problem.P[j]), {Inequality::kPair, rule, rule, rule, 0.0});
    for (std::size_t i = 0; i < plant_rules.size(); ++i) test_rule(problem, plant_rules[i], i, j, report);
    for (std::size_t k = j + 1; k < problem.P.size(); ++k) test_crossed(problem, plant_rules, j, k, report);
  }
  return report;
}

CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction) {
  std::vector<BoundedDynamics> rules;
  if (friction.rule_count > kMaxTemperatureRules) return certify(gains, rules);  // refuses
  for (int i = 0; i < plant_rule_count(friction); ++i) {
    rules.push_back(
        bounded_dynamics(plant, plant_rule_viscous_Nms_rad(friction, i), gains.has_integrator != 0));
  }
  return certify(gains, rules);
}

}  // namespace strainwave
