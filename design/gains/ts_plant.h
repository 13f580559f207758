// SPDX-License-Identifier: BSD-3-Clause
// The joint as a sampled Takagi-Sugeno plant, for which the gains are designed. cost_certificate.h checks
// them on it. J dw/dt = Tm - friction, d(theta)/dt = w. Friction feed-forward removes the static and Coulomb
// parts, so that each rule is linear with its own viscous coefficient. Source: Zhao (2006), (2-10),
// (3-9)..(3-35). Real-time safe.
#pragma once

#include <array>

#include "control/bounded.h"
#include "control/table/gain_table.h"

namespace strainwave {

/// x[k+1] = A x[k] + B u[k], x as in gain_table.h. Without an integrator the first row and column are zero.
struct SampledDynamics {
  StateMatrix A = StateMatrix::Zero();
  StateVector B = StateVector::Zero();
};

/// The same dynamics with a bound on the rounding error of every entry, for proofs.
struct BoundedDynamics {
  std::array<std::array<Bounded, kMaxStates>, kMaxStates> A{};
  std::array<Bounded, kMaxStates> B{};

  SampledDynamics values() const noexcept;
};

/// One rule: the joint `plant` with viscous coefficient `viscous_Nms_rad`. The solution is exact for a torque
/// that is constant over a period (zero-order hold), as in the loop. The integral row is the sum that the
/// controller computes: integral[k+1] = integral[k] + ts * error[k]. Inertia, period and viscous coefficient
/// count as exact.
BoundedDynamics bounded_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                                 bool has_integrator) noexcept;
/// The same rule without the bounds.
SampledDynamics sampled_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                                 bool has_integrator) noexcept;

/// Number of rules of the plant: the zero-velocity rule and one per temperature rule.
int plant_rule_count(const FuzzyFriction& friction) noexcept;

/// Viscous coefficient of a plant rule: 0 for rule 0 ("zero velocity"), that of temperature rule j-1 otherwise.
double plant_rule_viscous_Nms_rad(const FuzzyFriction& friction, int rule) noexcept;

}  // namespace strainwave
