// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/ts_plant.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// (1 - exp(-z)) / z, continuous at 0.
double phi1(double z) noexcept {
  return z == 0.0 ? 1.0 : -std::expm1(-z) / z;
}

// (exp(-z) - 1 + z) / z^2, continuous at 0. Up to |z| = 1, where the difference would cancel, it is a series.
double phi2(double z) noexcept {
  if (std::abs(z) > 1.0) return (std::expm1(-z) + z) / (z * z);
  double term = 0.5;
  double sum = term;
  for (int k = 3; std::abs(term) > 1e-18; ++k) {
    term *= -z / k;
    sum += term;
  }
  return sum;
}

}  // namespace

SampledDynamics BoundedDynamics::values() const noexcept {
  SampledDynamics dynamics;
  for (std::size_t i = 0; i < kMaxStates; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    dynamics.B(row) = B[i].value;
    for (std::size_t j = 0; j < kMaxStates; ++j)
      dynamics.A(row, static_cast<Eigen::Index>(j)) = A[i][j].value;
  }
  return dynamics;
}

BoundedDynamics bounded_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                                 bool has_integrator) noexcept {
  const Bounded period = plant.period_s;
  const Bounded inertia = plant.inertia_kgm2;
  BoundedDynamics dynamics;
  dynamics.A[1][1] = 1.0;
  if (has_integrator) {
    dynamics.A[0][0] = 1.0;
    dynamics.A[0][1] = period;
  }
  // The relative error of exp, expm1 and the series is a few half ulps. The difference in phi2 loses at most
  // a factor of 4 above z = 1. Rounding of z adds at most 3 |z| half ulps. So 64 ulps are a wide bound up to
  // z = 5, and 4 |z| more cover larger z.
  const double z = plant.period_s * viscous_Nms_rad / plant.inertia_kgm2;
  const double relative = 0x1p-52 * (64.0 + 4.0 * std::abs(z));
  const auto approximate = [relative](double value) { return Bounded(value, relative * std::abs(value)); };
  const Bounded first = approximate(phi1(z));
  dynamics.A[1][2] = period * first;
  dynamics.A[2][2] = approximate(std::exp(-z));
  dynamics.B[1] = period * period * approximate(phi2(z)) / inertia;
  dynamics.B[2] = period * first / inertia;
  return dynamics;
}

SampledDynamics sampled_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                                 bool has_integrator) noexcept {
  return bounded_dynamics(plant, viscous_Nms_rad, has_integrator).values();
}

int plant_rule_count(const FuzzyFriction& friction) noexcept {
  return 1 + friction.rule_count;
}

double plant_rule_viscous_Nms_rad(const FuzzyFriction& friction, int rule) noexcept {
  return rule == 0 ? 0.0 : friction.rules[static_cast<std::size_t>(rule - 1)].friction.viscous_Nms_rad;
}

}  // namespace strainwave
