// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/euler_plant.h"

#include <gtest/gtest.h>

#include "design/gains/cost_certificate.h"
#include "tests/support/eigenvalues.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

TEST(EulerPlant, IsOneStepOfTheSlope) {
  const SampledDynamics dynamics = euler_dynamics(testing::reference_identity(), 2.0, true).values();
  StateMatrix A;
  A << 1.0, 1e-3, 0.0, 0.0, 1.0, 1e-3, 0.0, 0.0, 1.0 - 1e-3 * 2.0 / 0.089;
  EXPECT_TRUE(dynamics.A.isApprox(A, 1e-15));
  EXPECT_TRUE(dynamics.B.isApprox(StateVector(0.0, 0.0, 1e-3 / 0.089), 1e-15));
}

TEST(EulerPlant, AgreesWithTheHoldToFirstOrderInThePeriod) {
  PlantIdentity plant = testing::reference_identity();
  plant.period_s = 1e-6;
  const SampledDynamics a = euler_dynamics(plant, 2.0, true).values();
  const SampledDynamics b = sampled_dynamics(plant, 2.0, true);
  EXPECT_LT((a.A - b.A).norm(), 1e-9);
  EXPECT_LT((a.B - b.B).norm(), 1e-9);
}

// By forward Euler the loop with these gains has both eigenvalues at -0.15, with a P that proves stability. With a zero-order hold the same gains
// have an eigenvalue at -1.41.
TEST(EulerPlant, ItsCertificateSaysNothingOfAJointThatIsHeld) {
  const PlantIdentity plant = testing::reference_identity();
  FuzzyFriction friction;
  friction.rule_count = 1;
  const double pole = -0.15;
  const GainRow F(0.0, -(1.0 - pole) * (1.0 - pole) * plant.inertia_kgm2 / (plant.period_s * plant.period_s),
                  -2.0 * (1.0 - pole) * plant.inertia_kgm2 / plant.period_s);
  const auto loop = [&F](const SampledDynamics& dynamics) {
    return Eigen::Matrix2d((dynamics.A + dynamics.B * F).bottomRightCorner<2, 2>());
  };
  const std::vector<BoundedDynamics> euler(2, euler_dynamics(plant, 0.0, false));
  const Eigen::Matrix2d H = loop(euler[0].values());
  Eigen::Matrix2d term = Eigen::Vector2d(1.0, plant.period_s * plant.period_s).asDiagonal();
  StateMatrix P = StateMatrix::Zero();
  for (int k = 0; k < 60; ++k) {
    P.bottomRightCorner<2, 2>() += term;
    term = (H.transpose() * term * H).eval();
  }
  P = (0.5 * (P + P.transpose())).eval();
  FeedbackGains gains;
  gains.rule_count = 1;
  gains.weights = {0.0, 1e-3, 1e-12, 1e-20};
  gains.set(0, F, P);

  EXPECT_TRUE(certify(gains, euler).certified);
  EXPECT_FALSE(certify(gains, plant, friction).certified);
  const Eigen::Matrix2d held = loop(sampled_dynamics(plant, 0.0, false));
  EXPECT_NEAR(testing::spectral_radius(held), 1.41, 0.01);
}

}  // namespace
}  // namespace strainwave
