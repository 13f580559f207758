// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/spring_proof.h"

#include <gtest/gtest.h>

#include <random>

#include "base/input_error.h"
#include "control/table/box_certificate.h"
#include "control/table/gain_table_json.h"
#include "design/gains/spring_verdict.h"

namespace strainwave {
namespace {

constexpr SpringLoop kLoop{1e-3, 1};

GainTable table_of_the_study() {
  return read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-0.178/c4.json");
}

SpringBox box_of(const GainTable& table, const BoxRange& link_inertia_kgm2) {
  return spring_box(table.friction, "csf-17-50", {0.089, 0.089}, link_inertia_kgm2);
}

TEST(SpringProof, TheBoxIsTheGearsSlopesAndEveryRulesFriction) {
  const GainTable table = table_of_the_study();
  const SpringBox box = box_of(table, {0.05, 0.3});
  EXPECT_EQ(box.stiffness_Nm_rad.from, 8100.0);
  EXPECT_EQ(box.stiffness_Nm_rad.to, 13000.0);
  EXPECT_EQ(box.viscous_Nms_rad.from, 0.0);
  EXPECT_EQ(box.viscous_Nms_rad.to, table.friction.rules[0].friction.viscous_Nms_rad);
  EXPECT_EQ(gains_of(table).size(), 6U);
  EXPECT_THROW(spring_box(table.friction, "csf-17-51", {0.089, 0.089}, {0.05, 0.3}), InputError);
}

// The proof covers mistaken temperatures and every slope, without damping.
TEST(SpringProof, ProvesATableOfTheStudyOnItsGear) {
  const GainTable table = table_of_the_study();
  const SpringProof proof = prove_spring_box(gains_of(table), box_of(table, {0.085, 0.093}), kLoop);
  EXPECT_EQ(proof.outcome, SpringOutcome::kCertified) << describe(proof);
  EXPECT_GT(proof.worst.margin, 0.0);
  // The proof checks each of six gains at each of eight corners.
  EXPECT_GE(proof.inequalities, static_cast<int>(proof.cells.size()) * (1 + 8 * 6));
}

TEST(SpringProof, ATableWithOneEntryDestroyedIsRefused) {
  for (const std::size_t entry : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    GainTable table = table_of_the_study();
    table.primary.F[3][entry] = -table.primary.F[3][entry];
    const SpringProof proof = prove_spring_box(gains_of(table), box_of(table, {0.085, 0.093}), kLoop);
    EXPECT_EQ(proof.outcome, SpringOutcome::kUnstable) << entry;
    EXPECT_EQ(proof.unstable.gain, 3) << entry;
  }
}

TEST(SpringProof, ASecondPeriodOfDelayIsNamedUnstableWithItsCorner) {
  const GainTable table = table_of_the_study();
  const SpringProof proof = prove_spring_box(gains_of(table), box_of(table, {0.05, 0.3}), {1e-3, 2});
  EXPECT_EQ(proof.outcome, SpringOutcome::kUnstable);
  EXPECT_GT(proof.unstable.radius, 1.02);
  EXPECT_EQ(proof.unstable.plant.stiffness_Nm_rad, 13000.0);
  EXPECT_NE(describe(proof).find("UNSTABLE"), std::string::npos) << describe(proof);
}

// These gains, in units of J/h^2 and J/h, stabilise a rigid joint with exact velocity and no delay, but not in the loop of the daemon.
TEST(SpringProof, NoDeceivingGainsAreProvedOnARigidJoint) {
  GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-0.356/c1.json");
  EXPECT_TRUE(box_of_rigid(table).certified) << box_of_rigid(table).text;
  const double J_kgm2 = table.plant.inertia_kgm2;
  const double h_s = table.plant.period_s;
  for (const auto& [stiffness, damping] : {std::pair{0.9, 1.9}, {0.5, 1.5}, {0.2, 1.0}}) {
    table.primary.set(0, GainRow(0.0, -stiffness * J_kgm2 / (h_s * h_s), -damping * J_kgm2 / h_s),
                      table.primary.lyapunov(0));
    const SpringVerdict verdict = box_of_rigid(table);
    EXPECT_FALSE(verdict.certified);
    EXPECT_NE(verdict.text.find("rigid, delay 2: UNSTABLE"), std::string::npos) << verdict.text;
    for (const int delay : {0, 1, 2}) {
      const BoxCell whole{delay, {}, {}, {}};
      const bool found =
          find_spring_lyapunov(gains_of(table), spring_box(table, whole), loop_of(table, delay)).has_value();
      EXPECT_EQ(found, delay == 0 && stiffness == 0.2) << stiffness << " at a delay of " << delay;
    }
  }
}

// Tests the statement directly: within a cell V falls for any joint and any blend of the gains, chosen anew at every sample.
TEST(SpringProof, WhatIsProvedFallsAlongARandomWalkThroughACell) {
  const GainTable table = table_of_the_study();
  const std::vector<GainRow> gains = gains_of(table);
  SpringBox cell = box_of(table, {0.085, 0.093});
  cell.stiffness_Nm_rad = {9000.0, 10000.0};
  const std::optional<ProofMatrix> P = find_spring_lyapunov(gains, cell, kLoop);
  ASSERT_TRUE(P);
  std::mt19937_64 random(12);
  std::exponential_distribution<double> exponential;
  const auto any = [&](const BoxRange& range) {
    return std::uniform_real_distribution<double>(range.from, range.to)(random);
  };
  Eigen::VectorXd x;
  for (int k = 0; k < 3000; ++k) {
    if (k % 100 == 0) x = Eigen::VectorXd::NullaryExpr(P->rows(), [&] { return any({-1.0, 1.0}); });
    GainRow blend = GainRow::Zero();
    double sum = 0.0;
    for (const GainRow& gain : gains) {
      const double weight = exponential(random);
      blend += weight * gain;
      sum += weight;
    }
    const SpringPlant plant{0.089, any(cell.link_inertia_kgm2), any(cell.stiffness_Nm_rad), 0.0,
                            any(cell.viscous_Nms_rad)};
    const BoundedMatrix sampled = spring_exponential(spring_generator(plant, kLoop.period_s));
    const Eigen::VectorXd next = spring_loop(sampled, blend / sum, kLoop).value * x;
    ASSERT_LT(next.dot(*P * next), x.dot(*P * x)) << k;
    x = next;
  }
}

}  // namespace
}  // namespace strainwave
