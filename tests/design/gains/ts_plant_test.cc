// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/ts_plant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

// Integrates the continuous joint under constant torque in many small steps (RK4), accurately enough for these tests.
StateVector integrate(StateVector state, double torque_Nm, const PlantIdentity& plant, double viscous) {
  const int steps = 1000;
  const double h = plant.period_s / steps;
  const auto slope = [&](const StateVector& x) {
    return StateVector(0.0, x(2), (torque_Nm - viscous * x(2)) / plant.inertia_kgm2);
  };
  for (int i = 0; i < steps; ++i) {
    const StateVector k1 = slope(state);
    const StateVector k2 = slope(state + 0.5 * h * k1);
    const StateVector k3 = slope(state + 0.5 * h * k2);
    const StateVector k4 = slope(state + h * k3);
    state += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return state;
}

TEST(TsPlant, ZeroOrderHoldIsTheSolutionOfTheDifferentialEquation) {
  const PlantIdentity plant = testing::reference_identity();
  for (const double viscous : {0.0, 1e-9, 0.27, 2.33, 80.0, 500.0}) {
    const SampledDynamics dynamics = sampled_dynamics(plant, viscous, false);
    const StateVector start(0.0, 0.2, 3.0);
    const StateVector expected = integrate(start, 7.0, plant, viscous);
    const StateVector actual = dynamics.A * start + dynamics.B * 7.0;
    EXPECT_NEAR(actual(1), expected(1), 1e-13) << viscous;
    EXPECT_NEAR(actual(2), expected(2), 1e-11) << viscous;
  }
}

TEST(TsPlant, WithoutAnIntegratorItsRowAndColumnAreZero) {
  const SampledDynamics dynamics = sampled_dynamics(testing::reference_identity(), 1.0, false);
  EXPECT_TRUE(dynamics.A.row(0).isZero(0.0) && dynamics.A.col(0).isZero(0.0) && dynamics.B(0) == 0.0);
}

TEST(TsPlant, SeriesAndClosedFormMeetWhereTheyChange) {
  const PlantIdentity plant = testing::reference_identity();
  const double border = plant.inertia_kgm2 / plant.period_s;  // ts Fv / J = 1
  const double below = sampled_dynamics(plant, border * (1.0 - 1e-12), false).B(1);
  const double above = sampled_dynamics(plant, border * (1.0 + 1e-12), false).B(1);
  EXPECT_NEAR(below, above, 1e-11 * below);
}

TEST(TsPlant, ErrorBoundsCoverLongDouble) {
  const PlantIdentity plant = testing::reference_identity();
  for (const double viscous : {0.1, 2.3, 50.0, 89.0, 120.0, 400.0}) {
    const BoundedDynamics dynamics = bounded_dynamics(plant, viscous, true);
    const long double ts = plant.period_s, J = plant.inertia_kgm2, a = viscous / J;
    const auto covers = [](const Bounded& bounded, long double exact) {
      return std::abs(bounded.value - exact) <= bounded.error;
    };
    EXPECT_TRUE(covers(dynamics.A[2][2], std::exp(-a * ts)));
    EXPECT_TRUE(covers(dynamics.A[1][2], -std::expm1(-a * ts) / a));
    EXPECT_TRUE(covers(dynamics.B[2], -std::expm1(-a * ts) / (a * J)));
    EXPECT_TRUE(covers(dynamics.B[1], (ts + std::expm1(-a * ts) / a) / (a * J)));
  }
}

TEST(TsPlant, RuleZeroHasNoViscousFriction) {
  FuzzyFriction friction;
  friction.rule_count = 2;
  friction.rules[0].friction.viscous_Nms_rad = 3.0;
  friction.rules[1].friction.viscous_Nms_rad = 1.0;
  EXPECT_EQ(plant_rule_count(friction), 3);
  EXPECT_EQ(plant_rule_viscous_Nms_rad(friction, 0), 0.0);
  EXPECT_EQ(plant_rule_viscous_Nms_rad(friction, 1), 3.0);
  EXPECT_EQ(plant_rule_viscous_Nms_rad(friction, 2), 1.0);
}

}  // namespace
}  // namespace strainwave
