// The certificate of a gain table: whoever receives a table can prove, in microseconds and without a solver,
// that its gains stabilise the plant for any time-varying weights. Real-time safe (but meant for admission,
// outside the loop).
//
// For all pairs of rules (j, l), with A_j, B the sampled plant and r the decay rate:
//     P_j - (A_j + B F_j)' P_l (A_j + B F_j) / r^2 - W - F_j' R F_j  > 0,   P_j > 0.
// Then V = x' (sum alpha_j P_j) x falls along every trajectory and bounds the cost. Source: Zhao (2006),
// (5-22), (5-23).
//
// Under a zero-order hold B_j differs between rules, and the blended feedback has cross terms:
//     x+ = sum_jk alpha_j alpha_k (A_j + B_j F_k) x = sum_j alpha_j^2 H_jj x + sum_{j<k} 2 alpha_j alpha_k
//     H_jk x, H_jk = (A_j + A_k + B_j F_k + B_k F_j) / 2.
// The factors alpha_j^2 and 2 alpha_j alpha_k sum to one and V is convex, so that with the pairs above it
// suffices that for all j < k and l
//     P_j + P_k - 2 H_jk' P_l H_jk / r^2 - 2 W - F_j' R F_j - F_k' R F_k  > 0,
// because sum_j alpha_j^2 P_j + sum_{j<k} alpha_j alpha_k (P_j + P_k) = sum_j alpha_j P_j. Where all B_j are
// equal (forward Euler, or one gain for every rule) H_jk is the mean of H_jj and H_kk and these follow from
// the pairs.
//
// Every number is carried with a bound on its rounding error (bounded.h), from inertia and period to the last
// product: the statement is about the real matrices, not about their floating-point images.
#pragma once

#include <array>

#include "control/gain_table.h"
#include "control/positive_definite.h"

namespace strainwave {

/// The matrix inequality that is closest to failing.
struct WorstPair {
  int from = 0;         ///< rule j before the step
  int from_other = 0;   ///< rule k of a cross pair, otherwise j
  int to = 0;           ///< rule l after it
  double margin = 0.0;  ///< as PositiveDefiniteResult::margin
};

/// Result for every pair; row: rule j before the step, column: rule l after it.
struct CertificateReport {
  bool certified = false;
  int rule_count = 0;        ///< of the plant; 0: gains and plant do not fit each other, nothing was tested
  int cross_pair_count = 0;  ///< number of cross pairs (j < k, l) that had to be tested besides
  std::array<std::array<PositiveDefiniteResult, kMaxRules>, kMaxRules> pairs{};
  WorstPair worst;  ///< over pairs, cross pairs and the P_j themselves (from == to)
};

/// Checks `gains` on the plant that `plant` (the receiver's own inertia and period) and `friction` describe.
/// A temperature-free controller is checked with its one gain and one P against every rule of the plant.
CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction) noexcept;

}  // namespace strainwave
