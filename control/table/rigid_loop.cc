// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/rigid_loop.h"

#include <cassert>
#include <iomanip>
#include <sstream>

#include "control/table/bounded_matrix.h"
#include "control/table/spring_certificate.h"
#include "control/table/ts_plant.h"

namespace strainwave {

namespace {

constexpr int kRigidLoopStates = 4;

}  // namespace

double rigid_loop_radius(const PlantIdentity& plant, double viscous_Nms_rad, const GainRow& gain,
                         bool has_integrator, int delay_periods) {
  assert(delay_periods >= 0 && delay_periods < kMaxProofStates - kRigidLoopStates);
  const Eigen::Index n = kRigidLoopStates + delay_periods;
  const SampledDynamics sampled = sampled_dynamics(plant, viscous_Nms_rad, has_integrator);
  ProofMatrix law = ProofMatrix::Zero(1, n);
  law(0, 0) = gain(0);
  law(0, 1) = gain(1) + gain(2) / plant.period_s;
  law(0, 3) = -gain(2) / plant.period_s;
  ProofMatrix H = ProofMatrix::Zero(n, n);
  H.topLeftCorner(3, 3) = sampled.A;
  H(3, 1) = 1.0;
  if (delay_periods > 0) {
    H.block(0, n - 1, 3, 1) = sampled.B;
    H.row(kRigidLoopStates) = law;
    for (Eigen::Index i = kRigidLoopStates + 1; i < n; ++i) H(i, i - 1) = 1.0;
  } else {
    H.topRows(3) += sampled.B.lazyProduct(law);
  }
  return spectral_radius(H);
}

std::optional<std::string> find_swing(const GainTable& table, int least_delay, int most_delay) {
  for (const FeedbackGains* gains : {&table.primary, &table.fallback})
    for (int rule = 0; rule < gains->rule_count; ++rule)
      for (int plant = 0; plant < plant_rule_count(table.friction); ++plant)
        for (int delay = least_delay; delay <= most_delay; ++delay) {
          const double radius =
              rigid_loop_radius(table.plant, plant_rule_viscous_Nms_rad(table.friction, plant),
                                gains->gain(rule), gains->has_integrator, delay);
          if (radius <= 1.0) continue;
          std::ostringstream text;
          text << std::setprecision(5) << gains->controller.view() << " rule " << rule
               << " makes a limit cycle at a delay of " << delay << " periods: eigenvalue " << radius
               << " a period, at most 1 is allowed; design softer gains (strainwave-design gains with a "
                  "larger "
                  "fourth number of --weights)";
          return text.str();
        }
  return std::nullopt;
}

}  // namespace strainwave
