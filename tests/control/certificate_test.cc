#include "control/certificate.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "control/gain_table_json.h"
#include "control/ts_plant.h"

namespace strainwave {
namespace {

GainTable table_of(const std::string& name) {
  return read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/" + name + ".json");
}

CertificateReport certify_primary(const GainTable& table) {
  return certify(table.primary, table.plant, table.friction);
}

TEST(Certificate, CertifiesAllFourControllersAndTheirFallbacks) {
  for (const char* const name : {"c1", "c2", "c3", "c4", "rhs17-6006"}) {
    const GainTable table = table_of(name);
    const CertificateReport primary = certify_primary(table);
    EXPECT_TRUE(primary.certified) << name;
    EXPECT_TRUE(certify(table.fallback, table.plant, table.friction).certified) << name;
    for (int j = 0; j < primary.rule_count; ++j) {
      for (int l = 0; l < primary.rule_count; ++l) {
        EXPECT_TRUE(primary.pairs[static_cast<std::size_t>(j)][static_cast<std::size_t>(l)].certain)
            << name << j << l;
      }
    }
  }
}

TEST(Certificate, RefusesAnUnstableGain) {
  GainTable table = table_of("c4");
  for (double& gain : table.primary.F[3]) gain = -gain;
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(report.worst.from, 3);
}

TEST(Certificate, RefusesOneChangedEntryOfPThatBreaksAPair) {
  GainTable table = table_of("c4");
  StateMatrix P = table.primary.lyapunov(2);
  P(1, 1) *= 1.2;  // rule 2 is now too expensive to enter
  table.primary.set(2, table.primary.gain(2), P);
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(report.worst.to, 2);
  EXPECT_TRUE(report.pairs[0][1].certain);  // pairs without rule 2 do not care
  EXPECT_FALSE(report.pairs[0][2].certain);
}

// Within a range of inertia the same gains are provably good; outside it they are not, and the receiver's own
// numbers decide.
TEST(Certificate, RefusesInertiasAndPeriodsThatTheGainsCannotControl) {
  const GainTable table = table_of("c4");
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
  GainTable table = table_of("c3");
  table.primary.set(0, table.primary.gain(0), -table.primary.lyapunov(0));
  EXPECT_FALSE(certify_primary(table).certified);
}

TEST(Certificate, RefusesGainsForAnotherNumberOfRules) {
  GainTable table = table_of("c4");
  --table.friction.rule_count;
  const CertificateReport report = certify_primary(table);
  EXPECT_FALSE(report.certified);
  EXPECT_EQ(report.rule_count, 0);
}

TEST(Certificate, RefusesAnIntegralGainWithoutIntegrator) {
  GainTable table = table_of("c2");
  table.primary.F[1][0] = -1.0;
  EXPECT_FALSE(certify_primary(table).certified);
}

TEST(Certificate, RefusesADecayFasterThanTheGainsGive) {
  GainTable table = table_of("c4");
  table.primary.decay_rate = 0.9;
  EXPECT_FALSE(certify_primary(table).certified);
}

TEST(Certificate, NotANumberAnywhereIsRefused) {
  GainTable table = table_of("c4");
  table.primary.F[0][0] = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
  table = table_of("c4");
  table.plant.inertia_kgm2 = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
  table = table_of("c4");
  table.friction.rules[4].friction.viscous_Nms_rad = std::nan("");
  EXPECT_FALSE(certify_primary(table).certified);
}

// The statement itself: the function V falls by the stage cost for random states and random weights before
// and after.
TEST(Certificate, WhatItCertifiesHoldsForRandomBlends) {
  std::mt19937_64 random(6);
  std::exponential_distribution<double> exponential;
  std::normal_distribution<double> normal;
  const auto weights = [&](int count) {
    Eigen::VectorXd alpha = Eigen::VectorXd::NullaryExpr(count, [&] { return exponential(random); });
    return Eigen::VectorXd(alpha / alpha.sum());
  };
  const GainTable table = table_of("c4");
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

TEST(Certificate, ZeroOrderHoldNeedsItsCrossPairs) {
  GainTable table = table_of("c4");
  EXPECT_EQ(certify_primary(table).cross_pair_count, 0);
  table.plant.sampling = Sampling::kZeroOrderHold;
  EXPECT_EQ(certify_primary(table).cross_pair_count, 15 * 6);
  EXPECT_EQ(certify(table.fallback, table.plant, table.friction).cross_pair_count, 0);  // one gain: none
}

}  // namespace
}  // namespace strainwave
