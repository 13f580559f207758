// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/spring_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "control/table/gain_table_json.h"
#include "control/table/positive_definite.h"
#include "tests/support/eigenvalues.h"

namespace strainwave {
namespace {

const SpringLoop kLoop{1e-3, 1};
const std::array<GainRow, 1> kGains{GainRow(-310.0, -990.0, -21.0)};
const SpringBox kBox{{0.0889, 0.0891}, {0.0999, 0.1001}, {9990.0, 10010.0}, {0.5, 0.51}, {0.0, 0.01}};

// Matrices of fixed size compile in a fraction of the time.
using LoopMatrix = Eigen::Matrix<double, 7, 7>;
using LoopState = Eigen::Matrix<double, 7, 1>;

// sum_k H'^k W H^k for the middle of `box`.
ProofMatrix lyapunov(const SpringBox& box) {
  const auto middle = [](const BoxRange& range) { return 0.5 * (range.from + range.to); };
  const SpringPlant plant{middle(box.motor_inertia_kgm2), middle(box.link_inertia_kgm2),
                          middle(box.stiffness_Nm_rad), middle(box.damping_Nms_rad),
                          middle(box.viscous_Nms_rad)};
  const BoundedMatrix sampled = spring_exponential(spring_generator(plant, kLoop.period_s));
  LoopMatrix H = spring_loop(sampled, kGains[0], kLoop).value;
  LoopState weights;
  weights << 0.1, 1.0, 1e-4, 100.0, 1e-4, 1e-2, 1e-6;
  LoopMatrix P = weights.asDiagonal();
  for (int k = 0; k < 26; ++k) {
    P = (P + H.transpose() * P * H).eval();
    H = (H * H).eval();
  }
  return 0.5 * (P + P.transpose());
}

TEST(SpringCertificate, CertifiesASmallBoxByTheLyapunovMatrixOfItsMiddle) {
  const SpringReport report = certify(kGains, kBox, kLoop, lyapunov(kBox));
  EXPECT_TRUE(report.certified) << describe(report);
  EXPECT_GE(report.inequalities, 1 + 32);
  EXPECT_GT(report.margin, 0.0);
}

// At each sample the joint takes new random values of stiffness, inertias, damping and friction in the box.
TEST(SpringCertificate, WhatItCertifiesFallsAlongARandomWalkThroughTheBox) {
  std::mt19937_64 random(11);
  const auto any = [&](const BoxRange& range) {
    return std::uniform_real_distribution<double>(range.from, range.to)(random);
  };
  const LoopMatrix P = lyapunov(kBox);
  LoopState x = LoopState::Unit(1);
  for (int k = 0; k < 20000; ++k) {
    const SpringPlant plant{any(kBox.motor_inertia_kgm2), any(kBox.link_inertia_kgm2),
                            any(kBox.stiffness_Nm_rad), any(kBox.damping_Nms_rad), any(kBox.viscous_Nms_rad)};
    const BoundedMatrix sampled = spring_exponential(spring_generator(plant, kLoop.period_s));
    const LoopMatrix H = spring_loop(sampled, kGains[0], kLoop).value;
    const LoopState next = H * x;
    ASSERT_LT(next.dot(P * next), x.dot(P * x)) << k;
    x = next;
    if (k % 500 == 499) x = LoopState::NullaryExpr([&] { return any({-1.0, 1.0}); });
  }
}

// least_fall() less its error is a lower bound, in the order of matrices, for every loop within the error bounds.
TEST(SpringCertificate, TheLeastFallIsBelowThatOfEveryLoopWithinTheErrors) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const BoundedMatrix P(lyapunov(kBox));
  const SpringPlant plant{0.089, 0.1, 10000.0, 0.5, 0.0};
  BoundedMatrix H =
      spring_loop(spring_exponential(spring_generator(plant, kLoop.period_s)), kGains[0], kLoop);
  for (const double size : {1e-6, 1e-5, 1e-4}) {
    for (Eigen::Index i = 1; i <= 4; ++i)
      for (Eigen::Index j = 1; j <= 4; ++j) H.error(i, j) = size * std::abs(H.value(i, j));
    const BoundedMatrix least = least_fall(P, H);
    for (int trial = 0; trial < 500; ++trial) {
      const bool ends = trial % 2 == 0;
      const ProofMatrix shares = ProofMatrix::NullaryExpr(
          7, 7, [&] { return ends ? std::copysign(1.0, any(random)) : any(random); });
      const ProofMatrix other = H.value + shares.cwiseProduct(H.error);
      const ProofMatrix fall = P.value - other.transpose() * P.value * other;
      const ProofMatrix above = fall - least.value + ProofMatrix(least.error.rowwise().sum().asDiagonal());
      ASSERT_TRUE(test_positive_definite(above, 1e-14 * above.cwiseAbs(), 7).certain) << size << " " << trial;
    }
  }
}

TEST(SpringCertificate, RefusesAWiderBoxAndALongerPeriod) {
  const ProofMatrix P = lyapunov(kBox);
  SpringBox wider = kBox;
  wider.stiffness_Nm_rad = {1000.0, 40000.0};
  EXPECT_FALSE(certify(kGains, wider, kLoop, P).certified);
  wider = kBox;
  wider.link_inertia_kgm2 = {0.02, 1.0};
  EXPECT_FALSE(certify(kGains, wider, kLoop, P).certified);
  wider = kBox;
  wider.motor_inertia_kgm2 = {0.02, 0.089};
  EXPECT_FALSE(certify(kGains, wider, kLoop, P).certified);
  EXPECT_FALSE(certify(kGains, kBox, {1e-2, 1}, P).certified);
}

// Feedback of the velocity from two readings damps the spring with one period of delay. With two it excites it, so no proof exists.
TEST(SpringCertificate, TheSecondPeriodOfDelayDrivesAStiffSpringWithoutDamping) {
  const SpringPlant light{0.089, 0.05, 13000.0, 0.0, 0.0};
  EXPECT_LT(spring_loop_radius(light, kGains[0], {1e-3, 1}), 1.0);
  EXPECT_GT(spring_loop_radius(light, kGains[0], {1e-3, 2}), 1.02);
}

// docs/flexible-joint.md states that there is little stability margin beyond this corner of the table's box.
TEST(SpringCertificate, TheDelaysTableHasLittleBesideItsBoxWhereAStiffSpringIsNotDamped) {
  const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50-delays.json");
  const std::vector<GainRow> gains = gains_of(table);
  const SpringPlant corner{0.089, 0.05, 13000.0, 0.0, 0.0};
  const SpringLoop loop{1e-3, 2, EncoderSide::kMotor, 2.0};
  const auto radius = [&](const SpringPlant& plant) {
    const BoundedMatrix sampled = spring_exponential(spring_generator(plant, loop.period_s));
    double largest = 0.0;
    for (const GainRow& gain : gains)
      largest = std::max(largest, testing::swing_radius(spring_loop(sampled, gain, loop).value, 0.1));
    return largest;
  };
  EXPECT_NEAR(radius(corner), 0.992, 0.0005);
  SpringPlant other = corner;
  for (const auto& [share, grows] : {std::pair(1.05, false), std::pair(1.06, true)}) {
    other.stiffness_Nm_rad = share * corner.stiffness_Nm_rad;
    EXPECT_EQ(radius(other) > 1.0, grows) << share << radius(other);
  }
  other = corner;
  for (const auto& [share, grows] : {std::pair(0.90, false), std::pair(0.89, true)}) {
    other.link_inertia_kgm2 = share * corner.link_inertia_kgm2;
    EXPECT_EQ(radius(other) > 1.0, grows) << share << radius(other);
  }
}

}  // namespace
}  // namespace strainwave
