// SPDX-License-Identifier: BSD-3-Clause
// Simulates the Takagi-Sugeno plant with blended feedback. The weights change at random at every sample, mostly between pure rules. The designs must
// withstand all such changes.
#pragma once

#include <random>

#include "design/gains/controller_design.h"
#include "design/gains/ts_plant.h"

namespace strainwave {

struct WorstCase {
  double cost = 0.0;
  double largest_torque_Nm = 0.0;
  StateVector largest = StateVector::Zero();  ///< largest magnitude of each state
  double final_ratio = 0.0;                   ///< |x| at the end over |x| at the start
};

inline WorstCase simulate_worst_case(const FeedbackGains& gains, const DesignRequest& request,
                                     const StateVector& start, int samples, std::mt19937_64& random) {
  const int rules = plant_rule_count(request.friction);
  const StateMatrix W =
      StateVector(gains.weights.integral, gains.weights.position, gains.weights.velocity).asDiagonal();
  std::exponential_distribution<double> exponential;
  std::uniform_int_distribution<int> pick(0, rules - 1);
  WorstCase trajectory;
  StateVector x = start;
  for (int k = 0; k < samples; ++k) {
    Eigen::VectorXd alpha = Eigen::VectorXd::Unit(rules, pick(random));
    if (pick(random) == 0) {
      alpha = Eigen::VectorXd::NullaryExpr(rules, [&] { return exponential(random); });
      alpha /= alpha.sum();
    }
    double u = 0.0;
    for (int j = 0; j < rules; ++j) u += alpha(j) * gains.gain(gains.scheduled() ? j : 0).dot(x);
    trajectory.cost += x.dot(W * x) + gains.weights.torque * u * u;
    trajectory.largest_torque_Nm = std::max(trajectory.largest_torque_Nm, std::abs(u));
    trajectory.largest = trajectory.largest.cwiseMax(x.cwiseAbs());
    StateVector next = StateVector::Zero();
    for (int j = 0; j < rules; ++j) {
      const SampledDynamics plant = sampled_dynamics(
          request.plant, plant_rule_viscous_Nms_rad(request.friction, j), gains.has_integrator != 0);
      next += alpha(j) * (plant.A * x + plant.B * u);
    }
    x = next;
  }
  trajectory.final_ratio = x.norm() / start.norm();
  return trajectory;
}

}  // namespace strainwave
