// The certificate of a gain table: whoever receives a table can prove, in microseconds and without a solver, that its
// gains stabilise the plant for any time-varying weights. Real-time safe (but meant for admission, outside the loop).
//
// For all pairs of rules (j, l), with A_j, B the sampled plant and r the decay rate:
//     P_j - (A_j + B F_j)' P_l (A_j + B F_j) / r^2 - W - F_j' R F_j  > 0,   P_j > 0.
// Then V = x' (sum alpha_j P_j) x falls along every trajectory and bounds the cost. Source: Zhao (2006), (5-22), (5-23).
#pragma once

#include <array>

#include "control/gain_table.h"
#include "control/positive_definite.h"

namespace strainwave {

/// Result for every pair; row: rule j before the step, column: rule l after it.
struct CertificateReport {
  bool certified = false;
  int rule_count = 0;
  std::array<std::array<PositiveDefiniteResult, kMaxRules>, kMaxRules> pairs{};
  int worst_from = 0;
  int worst_to = 0;
  double worst_margin = 0.0;
};

/// Checks `gains` on the plant that `plant` (the receiver's own inertia and period) and `friction` describe. A
/// temperature-free controller is checked with its one gain and one P against every rule of the plant.
CertificateReport certify(const FeedbackGains& gains, const PlantIdentity& plant, const FuzzyFriction& friction) noexcept;

}  // namespace strainwave
