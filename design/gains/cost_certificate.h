// SPDX-License-Identifier: BSD-3-Clause
// Checks the matrix inequalities of the design with a bound on every rounding error. They promise that the gains stabilise the
// sampled joint for any time-varying weights, right or wrong, and bound the cost. This joint has no delay and an exact velocity.
// The daemon checks another statement, about the loop that it closes (control/table/box_certificate.h). Not real-time.
//
// With A_i, B_i rule i of the plant under a zero-order hold, H_ij = A_i + B_i F_j and r the decay rate:
//
//   pairs     P_j - H_jj' P_l H_jj / r^2 - W - F_j' R F_j  > 0                            all j, l;  P_j > 0
//   crossed   P_j + P_k - 2 H' P_l H / r^2 - 2 W - F_j' R F_j - F_k' R F_k  > 0           all j < k, l
//             with H = (H_jk + H_kj) / 2
//   mistaken  P_j - H_ij' P_l H_ij / r^2  > 0                                             all i != j, l
//
// Let the joint be sum_i alpha_i (A_i, B_i). The controller weighs its rules by beta now and by gamma in the next period;
// V = x' (sum_j beta_j P_j) x. With correct weights, alpha = beta and
//     x+ = sum_j beta_j^2 H_jj x + sum_{j<k} 2 beta_j beta_k H x.
// The factors sum to one and V is convex. Pairs and crossed therefore give V+ < r^2 (V - x'Wx - u'Ru): V falls and
// bounds the cost. With wrong weights (a wrong temperature), x+ = sum_ij alpha_i beta_j H_ij x. Pairs and mistaken then
// give V+ < r^2 V: the loop is stable whatever the weights are. Source: Zhao (2006), (5-22), (5-23), for the pairs.
//
// Every number has a bound on its rounding error (bounded.h), from inertia and period to the last product.
// The statement therefore holds for the real matrices, not only for their floating-point approximations.
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
  int plant_rules = 0;  ///< 0: gains and plant do not match, nothing was tested
  int gain_rules = 0;   ///< 1 for a temperature-free controller
  int inequalities = 0;
  WorstInequality worst;  ///< over all inequalities and P_j > 0 (kPair)
};

/// Checks `gains` on the joint of `plant` and `friction` under a zero-order hold. `plant` has the receiver's
/// own inertia and period.
CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant,
                          const FuzzyFriction& friction);

/// The same inequalities for given rules of the plant, 2 to kMaxRules. The first form calculates the rules
/// with bounded_dynamics().
CertificateReport certify(const FeedbackGains& gains, std::span<const BoundedDynamics> plant_rules);

}  // namespace strainwave
