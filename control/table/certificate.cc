// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/certificate.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

namespace strainwave {

namespace {

using BoundedVector = std::array<Bounded, kMaxStates>;
using BoundedSquare = std::array<BoundedVector, kMaxStates>;

// Only the leading n x n block counts. Controllers without an integrator are moved up and left by one state.
struct Problem {
  std::size_t first = 0;
  std::size_t n = 0;
  std::size_t rules = 0;  // of the controller
  double torque_weight = 0.0;
  Bounded squared_rate = 1.0;
  BoundedVector state_weights{};
  std::array<BoundedVector, kMaxRules> F{};
  std::array<BoundedSquare, kMaxRules> P{};
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

Problem make_problem(const FeedbackGains& gains) noexcept {
  Problem problem;
  problem.first = gains.has_integrator ? 0 : 1;
  problem.n = kMaxStates - problem.first;
  problem.rules = static_cast<std::size_t>(gains.rule_count);
  problem.torque_weight = gains.weights.torque;
  problem.squared_rate = Bounded(gains.decay_rate) * gains.decay_rate;
  const std::array<double, kMaxStates> weights{gains.weights.integral, gains.weights.position,
                                               gains.weights.velocity};
  for (std::size_t a = 0; a < problem.n; ++a) problem.state_weights[a] = weights[problem.first + a];
  for (std::size_t j = 0; j < problem.rules; ++j) {
    for (std::size_t a = 0; a < problem.n; ++a) {
      problem.F[j][a] = gains.F[j][problem.first + a];
      for (std::size_t b = 0; b < problem.n; ++b)
        problem.P[j][a][b] = gains.P[j][(problem.first + a) * kMaxStates + problem.first + b];
    }
  }
  return problem;
}

// A + B F.
BoundedSquare closed_loop(const Problem& problem, const BoundedDynamics& plant,
                          const BoundedVector& F) noexcept {
  BoundedSquare H{};
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      H[a][b] = plant.A[problem.first + a][problem.first + b] + plant.B[problem.first + a] * F[b];
    }
  }
  return H;
}

// H' P H.
BoundedSquare congruence(const BoundedSquare& H, const BoundedSquare& P, std::size_t n) noexcept {
  BoundedSquare PH{};
  BoundedSquare result{};
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t k = 0; k < n; ++k) PH[a][b] = PH[a][b] + P[a][k] * H[k][b];
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t k = 0; k < n; ++k) result[a][b] = result[a][b] + H[k][a] * PH[k][b];
    }
  }
  return result;
}

PositiveDefiniteResult test(const Problem& problem, const BoundedSquare& matrix) noexcept {
  StateMatrix value = StateMatrix::Zero();
  StateMatrix error = StateMatrix::Zero();
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      value(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = matrix[a][b].value;
      error(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = matrix[a][b].error;
    }
  }
  return test_positive_definite(value, error, static_cast<int>(problem.n));
}

// P_j, less the stage cost W + F_j' R F_j if it counts.
BoundedSquare allowance(const Problem& problem, std::size_t j, bool with_cost) noexcept {
  BoundedSquare left = problem.P[j];
  if (!with_cost) return left;
  for (std::size_t a = 0; a < problem.n; ++a) {
    left[a][a] = left[a][a] - problem.state_weights[a];
    for (std::size_t b = 0; b < problem.n; ++b)
      left[a][b] = left[a][b] - problem.F[j][a] * problem.torque_weight * problem.F[j][b];
  }
  return left;
}

// allowed - copies H' P_l H / r^2 > 0.
PositiveDefiniteResult test_step(const Problem& problem, const BoundedSquare& allowed, double copies,
                                 const BoundedSquare& H, std::size_t l) noexcept {
  const BoundedSquare next = congruence(H, problem.P[l], problem.n);
  BoundedSquare difference{};
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b)
      difference[a][b] = allowed[a][b] - copies * next[a][b] / problem.squared_rate;
  }
  return test(problem, difference);
}

void keep_worst(CertificateReport& report, const PositiveDefiniteResult& result,
                const WorstInequality& which) noexcept {
  report.certified = report.certified && result.certain;
  if (result.margin < report.worst.margin) {
    report.worst = which;
    report.worst.margin = result.margin;
  }
}

// One rule of the plant under one gain, to every next rule.
void test_rule(const Problem& problem, const BoundedDynamics& plant, std::size_t i, std::size_t j,
               CertificateReport& report) noexcept {
  const bool own = problem.rules == 1 || i == j;
  const BoundedSquare H = closed_loop(problem, plant, problem.F[j]);
  const BoundedSquare allowed = allowance(problem, j, own);
  PositiveDefiniteResult& worst = report.worst_next[i][j];
  worst = {true, std::numeric_limits<double>::infinity()};
  for (std::size_t l = 0; l < problem.rules; ++l) {
    const PositiveDefiniteResult result = test_step(problem, allowed, 1.0, H, l);
    keep_worst(report, result,
               {own ? Inequality::kPair : Inequality::kMistaken, static_cast<int>(i), static_cast<int>(j),
                static_cast<int>(l), 0.0});
    ++report.inequalities;
    worst = {worst.certain && result.certain, std::min(worst.margin, result.margin)};
  }
}

void test_crossed(const Problem& problem, std::span<const BoundedDynamics> plant, std::size_t j,
                  std::size_t k, CertificateReport& report) noexcept {
  BoundedSquare H = closed_loop(problem, plant[j], problem.F[k]);
  const BoundedSquare mirrored = closed_loop(problem, plant[k], problem.F[j]);
  BoundedSquare allowed = allowance(problem, j, true);
  const BoundedSquare other = allowance(problem, k, true);
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      H[a][b] = Bounded(0.5) * (H[a][b] + mirrored[a][b]);
      allowed[a][b] = allowed[a][b] + other[a][b];
    }
  }
  for (std::size_t l = 0; l < problem.rules; ++l) {
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
  for (std::size_t j = 0; j < problem.rules; ++j) {
    const int rule = static_cast<int>(j);
    keep_worst(report, test(problem, problem.P[j]), {Inequality::kPair, rule, rule, rule, 0.0});
    for (std::size_t i = 0; i < plant_rules.size(); ++i) test_rule(problem, plant_rules[i], i, j, report);
    for (std::size_t k = j + 1; k < problem.rules; ++k) test_crossed(problem, plant_rules, j, k, report);
  }
  return report;
}

CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction) {
  std::vector<BoundedDynamics> rules;
  if (friction.rule_count > kMaxTemperatureRules) return certify(gains, rules);  // fits nothing
  for (int i = 0; i < plant_rule_count(friction); ++i) {
    rules.push_back(
        bounded_dynamics(plant, plant_rule_viscous_Nms_rad(friction, i), gains.has_integrator != 0));
  }
  return certify(gains, rules);
}

}  // namespace strainwave
