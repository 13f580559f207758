// SPDX-License-Identifier: BSD-3-Clause
// What the design's matrix inequalities promise, checked with every rounding bounded: the gains stabilise the sampled and held joint for any
// time-varying weights, right or wrong, and bound the cost. That joint has no delay and an exact velocity: what is proved of the loop
// that the daemon closes is another statement (control/table/box_certificate.h), and the one that the daemon checks. Not real-time.
//
// With A_i, B_i rule i of the plant under a zero-order hold, H_ij = A_i + B_i F_j and r the decay rate:
//
//   pairs     P_j - H_jj' P_l H_jj / r^2 - W - F_j' R F_j  > 0                            all j, l;  P_j > 0
//   crossed   P_j + P_k - 2 H' P_l H / r^2 - 2 W - F_j' R F_j - F_k' R F_k  > 0           all j < k, l
//             with H = (H_jk + H_kj) / 2
//   mistaken  P_j - H_ij' P_l H_ij / r^2  > 0                                             all i != j, l
//
// Let the joint be sum_i alpha_i (A_i, B_i), and the controller weigh its rules by beta now and gamma next, with
// V = x' (sum_j beta_j P_j) x. When it takes the joint for what it is, alpha = beta,
//     x+ = sum_j beta_j^2 H_jj x + sum_{j<k} 2 beta_j beta_k H x,
// the factors sum to one and V is convex, so that pairs and crossed give V+ < r^2 (V - x'Wx - u'Ru): V falls and
// bounds the cost. When it does not (a wrong temperature), x+ = sum_ij alpha_i beta_j H_ij x, and pairs and
// mistaken give V+ < r^2 V: the loop is stable, whatever it takes the joint for. Source: Zhao (2006), (5-22),
// (5-23), for the pairs.
//
// Every number is carried with a bound on its rounding error (bounded.h), from inertia and period to the last
// product: the statement is about the real matrices, not about their floating-point images.
#pragma once

#include <span>
#include <string>

#include "control/table/gain_table.h"
#include "control/table/positive_definite.h"
#include "design/gains/ts_plant.h"

namespace strainwave {

enum class Inequality { kPair, kCrossed, kMistaken };

/// The matrix inequality that is closest to failing.
struct WorstInequality {
  Inequality kind = Inequality::kPair;
  int plant = 0;        ///< rule i of the plant (k of a crossed pair)
  int from = 0;         ///< rule j of the controller before the step
  int to = 0;           ///< rule l after it
  double margin = 0.0;  ///< as PositiveDefiniteResult::margin
};

/// Margin and rules in words.
std::string describe(const WorstInequality& worst);

struct CertificateReport {
  bool certified = false;
  int plant_rules = 0;  ///< 0: gains and plant do not fit each other, nothing was tested
  int gain_rules = 0;   ///< 1 for a temperature-free controller
  int inequalities = 0;
  WorstInequality worst;  ///< over all of them and the P_j themselves (pairs)
};

/// Checks `gains` on the joint that `plant` (the receiver's own inertia and period) and `friction` describe,
/// sampled and held.
CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction);

/// The same inequalities for rules of a plant that is given: what the first form does with
/// bounded_dynamics(). 2 to kMaxRules rules.
CertificateReport certify(const FeedbackGains& gains, std::span<const BoundedDynamics> plant_rules);

}  // namespace strainwave
