#include "control/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/ts_plant.h"

namespace strainwave {

namespace {

using BoundedVector = std::array<Bounded, kMaxStates>;
using BoundedMatrix = std::array<BoundedVector, kMaxStates>;

// Only the leading n x n block counts. Controllers without an integrator are moved up and left by one state.
struct Problem {
  std::size_t n = 0;
  std::size_t rules = 0;  // of the plant
  bool scheduled = false;
  double torque_weight = 0.0;
  double decay_rate = 1.0;
  std::array<double, kMaxStates> state_weights{};
  std::array<BoundedDynamics, kMaxRules> dynamics{};
  std::array<BoundedVector, kMaxRules> F{};
  std::array<BoundedMatrix, kMaxRules> P{};

  // A temperature-free controller has one F and one P for every rule.
  std::size_t of(std::size_t plant_rule) const noexcept { return scheduled ? plant_rule : 0; }
};

bool fits(const FeedbackGains& gains, int plant_rules) noexcept {
  if (plant_rules < 2 || plant_rules > kMaxRules) return false;
  if (gains.rule_count != 1 && gains.rule_count != plant_rules) return false;
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

Problem make_problem(const FeedbackGains& gains, const PlantIdentity& plant,
                     const FuzzyFriction& friction) noexcept {
  const std::size_t first = gains.has_integrator ? 0 : 1;
  Problem problem;
  problem.n = kMaxStates - first;
  problem.rules = static_cast<std::size_t>(plant_rule_count(friction));
  problem.scheduled = gains.scheduled();
  problem.torque_weight = gains.weights.torque;
  problem.decay_rate = gains.decay_rate;
  const std::array<double, kMaxStates> weights{gains.weights.integral, gains.weights.position,
                                               gains.weights.velocity};
  std::copy(weights.begin() + static_cast<std::ptrdiff_t>(first), weights.end(),
            problem.state_weights.begin());

  for (std::size_t j = 0; j < problem.rules; ++j) {
    const double viscous_Nms_rad = plant_rule_viscous_Nms_rad(friction, static_cast<int>(j));
    const BoundedDynamics full = bounded_dynamics(plant, viscous_Nms_rad, gains.has_integrator != 0);
    for (std::size_t a = 0; a < problem.n; ++a) {
      problem.dynamics[j].B[a] = full.B[first + a];
      for (std::size_t b = 0; b < problem.n; ++b) problem.dynamics[j].A[a][b] = full.A[first + a][first + b];
    }
  }
  for (std::size_t j = 0; j < static_cast<std::size_t>(gains.rule_count); ++j) {
    for (std::size_t a = 0; a < problem.n; ++a) {
      problem.F[j][a] = gains.F[j][first + a];
      for (std::size_t b = 0; b < problem.n; ++b)
        problem.P[j][a][b] = gains.P[j][(first + a) * kMaxStates + first + b];
    }
  }
  return problem;
}

// The closed loop of plant rule `rule` under gain `F`: A + B F.
BoundedMatrix closed_loop(const Problem& problem, std::size_t rule, const BoundedVector& F) noexcept {
  BoundedMatrix H{};
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      H[a][b] = problem.dynamics[rule].A[a][b] + problem.dynamics[rule].B[a] * F[b];
    }
  }
  return H;
}

// H' P H.
BoundedMatrix congruence(const BoundedMatrix& H, const BoundedMatrix& P, std::size_t n) noexcept {
  BoundedMatrix PH{};
  BoundedMatrix result{};
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

// P_j - H' P_l H / r^2 - W - F_j' R F_j, with the sums over the two rules of a cross pair (j == k: a plain
// pair, once).
PositiveDefiniteResult test_inequality(const Problem& problem, const BoundedMatrix& H, std::size_t j,
                                       std::size_t k, std::size_t l) noexcept {
  const bool cross = j != k;
  const Bounded copies = cross ? 2.0 : 1.0;
  const Bounded squared_rate = Bounded(problem.decay_rate) * problem.decay_rate;
  const BoundedMatrix next = congruence(H, problem.P[problem.of(l)], problem.n);
  const auto rule_terms = [&problem](std::size_t rule, std::size_t a, std::size_t b) {
    const std::size_t own = problem.of(rule);
    return problem.P[own][a][b] - problem.F[own][a] * problem.torque_weight * problem.F[own][b];
  };
  StateMatrix value = StateMatrix::Zero();
  StateMatrix error = StateMatrix::Zero();
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      const Bounded stage = (a == b) ? Bounded(problem.state_weights[a]) : Bounded();
      Bounded entry = rule_terms(j, a, b);
      if (cross) entry = entry + rule_terms(k, a, b);
      entry = entry - copies * (next[a][b] / squared_rate + stage);
      value(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = entry.value;
      error(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = entry.error;
    }
  }
  return test_positive_definite(value, error, static_cast<int>(problem.n));
}

PositiveDefiniteResult test_lyapunov(const Problem& problem, std::size_t j) noexcept {
  StateMatrix value = StateMatrix::Zero();
  for (std::size_t a = 0; a < problem.n; ++a) {
    for (std::size_t b = 0; b < problem.n; ++b) {
      value(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          problem.P[problem.of(j)][a][b].value;
    }
  }
  return test_positive_definite(value, StateMatrix::Zero(), static_cast<int>(problem.n));
}

void keep_worst(CertificateReport& report, const PositiveDefiniteResult& result, std::size_t j, std::size_t k,
                std::size_t l) noexcept {
  report.certified = report.certified && result.certain;
  if (result.margin < report.worst.margin) {
    report.worst = {static_cast<int>(j), static_cast<int>(k), static_cast<int>(l), result.margin};
  }
}

void test_cross_pairs(const Problem& problem, CertificateReport& report) noexcept {
  for (std::size_t j = 0; j < problem.rules; ++j) {
    for (std::size_t k = j + 1; k < problem.rules; ++k) {
      BoundedMatrix H = closed_loop(problem, j, problem.F[problem.of(k)]);
      const BoundedMatrix mirrored = closed_loop(problem, k, problem.F[problem.of(j)]);
      for (std::size_t a = 0; a < problem.n; ++a) {
        for (std::size_t b = 0; b < problem.n; ++b) H[a][b] = Bounded(0.5) * (H[a][b] + mirrored[a][b]);
      }
      for (std::size_t l = 0; l < problem.rules; ++l) {
        keep_worst(report, test_inequality(problem, H, j, k, l), j, k, l);
        ++report.cross_pair_count;
      }
    }
  }
}

}  // namespace

CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction) noexcept {
  CertificateReport report;
  report.worst.margin = -std::numeric_limits<double>::infinity();
  if (!fits(gains, plant_rule_count(friction))) return report;
  const Problem problem = make_problem(gains, plant, friction);

  report.certified = true;
  report.rule_count = static_cast<int>(problem.rules);
  report.worst.margin = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < problem.rules; ++j) {
    keep_worst(report, test_lyapunov(problem, j), j, j, j);
    const BoundedMatrix H = closed_loop(problem, j, problem.F[problem.of(j)]);
    for (std::size_t l = 0; l < problem.rules; ++l) {
      report.pairs[j][l] = test_inequality(problem, H, j, j, l);
      keep_worst(report, report.pairs[j][l], j, j, l);
    }
  }
  // One gain for every rule, or one B: the cross pairs follow from the pairs.
  if (problem.scheduled && plant.sampling == Sampling::kZeroOrderHold) test_cross_pairs(problem, report);
  return report;
}

}  // namespace strainwave
