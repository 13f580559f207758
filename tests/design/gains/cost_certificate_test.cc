// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/cost_certificate.h"

#include <gtest/gtest.h>

#include <random>

#include "design/gains/ts_plant.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

CertificateReport certify_primary(const GainTable& table) {
  return certify(table.primary, table.plant, table.friction);
}

TEST(Certificate, CertifiesTheShippedTable) {
  const GainTable table = testing::shipped_table("rhs17-6006");
  const CertificateReport primary = certify_primary(table);
  EXPECT_TRUE(primary.certified);
  EXPECT_EQ(primary.inequalities, 6 * 6 + 15 * 6 + 30 * 6);  // pairs, crossed, mistaken
}

// These tables were designed by forward Euler, for chapter 6 of the source.
TEST(Certificate, WhatATableSaysOfItsSamplingChangesNothing) {
  for (const char* const name : {"c1", "c2", "c3", "c4", "rhs17-6006"}) {
    GainTable table = testing::shipped_table(name);
    table.provenance.sampling = Sampling::kForwardEuler;
    const CertificateReport euler = certify_primary(table);
    table.provenance.sampling = Sampling::kZeroOrderHold;
    EXPECT_EQ(euler.worst.margin, certify_primary(table).worst.margin);
    EXPECT_EQ(euler.certified, std::string(name) == "rhs17-6006") << name;
  }
}

TEST(Certificate, RefusesAnUnstableGain) {
  GainTable table = testing::shipped_table("rhs17-6006");
  for (double& gain : table.primary.F[3]) gain = -gain;
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_TRUE(report.worst.from == 3 || report.worst.plant == 3) << describe(report.worst);
}

TEST(Certificate, RefusesOneChangedEntryOfPThatBreaksAPair) {
  GainTable table = testing::shipped_table("rhs17-6006");
  StateMatrix P = table.primary.lyapunov(2);
  P(1, 1) *= 1.2;  // makes a transition to rule 2 too expensive
  table.primary.set(2, table.primary.gain(2), P);
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(report.worst.to, 2);
}

// The same gains are provably good only within a range of inertia. The certificate uses the receiver's own numbers.
TEST(Certificate, RefusesInertiasAndPeriodsThatTheGainsCannotControl) {
  const GainTable table = testing::shipped_table("rhs17-6006");
  for (const double factor : {0.01, 1.5, 10.0}) {
    PlantIdentity other = table.plant;
    other.inertia_kgm2 *= factor;
    EXPECT_FALSE(certify(table.primary, other, table.friction).certified) << factor;
  }
  PlantIdentity slower = table.plant;
  slower.period_s *= 20.0;
  EXPECT_FALSE(certify(table.primary, slower, table.friction).certified);
}

TEST(Certificate, RefusesAPThatIsNotPositiveEvenIfTheGainsAreStable) {
  GainTable table = testing::shipped_table("rhs17-6006");
  table.primary.set(0, table.primary.gain(0), -table.primary.lyapunov(0));
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(describe(report.worst).find("inf"), std::string::npos) << describe(report.worst);
}

TEST(Certificate, RefusesGainsForAnotherNumberOfRules) {
  GainTable table = testing::shipped_table("rhs17-6006");
  --table.friction.rule_count;
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(report.plant_rules, 0);
}

TEST(Certificate, RefusesAnIntegralGainWithoutIntegrator) {
  GainTable table = testing::shipped_table("c2");
  table.primary.F[1][0] = -1.0;
  EXPECT_EQ(certify_primary(table).plant_rules, 0);
}

TEST(Certificate, RefusesADecayFasterThanTheGainsGive) {
  GainTable table = testing::shipped_table("rhs17-6006");
  table.primary.decay_rate = 0.9;
  EXPECT_FALSE(certify_primary(table).certified);
}

TEST(Certificate, NotANumberAnywhereIsRefused) {
  GainTable table = testing::shipped_table("rhs17-6006");
  table.primary.F[0][0] = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
  table = testing::shipped_table("rhs17-6006");
  table.plant.inertia_kgm2 = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
  table = testing::shipped_table("rhs17-6006");
  table.friction.rules[4].friction.viscous_Nms_rad = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
}

// Tests the certified statement directly: V falls by the stage cost for random states, with random weights before and after the step.
TEST(Certificate, WhatItCertifiesHoldsForRandomBlends) {
  std::mt19937_64 random(6);
  std::exponential_distribution<double> exponential;
  std::normal_distribution<double> normal;
  const auto weights = [&](int count) {
    Eigen::VectorXd alpha = Eigen::VectorXd::NullaryExpr(count, [&] { return exponential(random); });
    return Eigen::VectorXd(alpha / alpha.sum());
  };
  const GainTable table = testing::shipped_table("rhs17-6006");
  const FeedbackGains& gains = table.primary;
  const StateMatrix W =
      StateVector(gains.weights.integral, gains.weights.position, gains.weights.velocity).asDiagonal();
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::VectorXd alpha = weights(gains.rule_count);
    const Eigen::VectorXd beta = weights(gains.rule_count);
    const StateVector x = StateVector::NullaryExpr([&] { return normal(random); });
    double u = 0.0;
    for (int k = 0; k < gains.rule_count; ++k) u += alpha(k) * gains.gain(k).dot(x);
    StateVector next = StateVector::Zero();
    double V = 0.0;
    for (int j = 0; j < gains.rule_count; ++j) {
      const SampledDynamics plant =
          sampled_dynamics(table.plant, plant_rule_viscous_Nms_rad(table.friction, j), true);
      next += alpha(j) * (plant.A * x + plant.B * u);
      V += alpha(j) * x.dot(gains.lyapunov(j) * x);
    }
    double V_next = 0.0;
    for (int l = 0; l < gains.rule_count; ++l) V_next += beta(l) * next.dot(gains.lyapunov(l) * next);
    ASSERT_LT(V_next, V - x.dot(W * x) - gains.weights.torque * u * u);
  }
}

// The joint has one rule, the controller assumes another, and a third one in the next sample.
TEST(Certificate, AMistakenTemperatureKeepsTheLoopStable) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const GainTable table = testing::shipped_table("rhs17-6006");
  const FeedbackGains& gains = table.primary;
  std::uniform_int_distribution<int> pick(0, gains.rule_count - 1);
  for (int trial = 0; trial < 5000; ++trial) {
    const StateVector x = StateVector::NullaryExpr([&] { return normal(random); });
    const int from = pick(random);
    const SampledDynamics plant =
        sampled_dynamics(table.plant, plant_rule_viscous_Nms_rad(table.friction, pick(random)), true);
    const StateVector next = plant.A * x + plant.B * gains.gain(from).dot(x);
    ASSERT_LT(next.dot(gains.lyapunov(pick(random)) * next), x.dot(gains.lyapunov(from) * x));
  }
}

}  // namespace
}  // namespace strainwave
