// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/lqg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

ServoJoint joint_with(double load_inertia_kgm2, double delay_periods = 1.0) {
  JointPlantConfig plant = flexible_plant();
  plant.effects.transmission->link_inertia_kgm2 = load_inertia_kgm2;
  plant.delay.periods = delay_periods;
  return servo_joint(plant);
}

double weight(double acceptable) {
  return 1.0 / (acceptable * acceptable);
}

// Reference: value iteration on the joint with the delayed torque as a state, [ x, u one period ago ].
TEST(Lqg, ItsGainCarriedOverTheDelayIsTheOptimumWithTheTorqueUnderWayAsAState) {
  const ServoJoint joint = joint_with(0.1);
  const LqgWeights weights = lqg_weights(joint);
  const LqgDesign design = design_lqg(joint, weights);
  Eigen::Matrix<double, 5, 5> A = design.sampled;
  A.row(4).setZero();
  const Eigen::Matrix<double, 5, 1> B = Eigen::Matrix<double, 5, 1>::Unit(4);
  Eigen::Matrix<double, 4, 5> weighted;  // [ thl, wl, thm, wm ]
  weighted << 1, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0;
  const Eigen::Vector4d W(weight(weights.link_position_rad), weight(weights.velocity_rad_s),
                          weight(weights.motor_position_rad), weight(weights.velocity_rad_s));
  const Eigen::Matrix<double, 5, 5> Q = weighted.transpose() * W.asDiagonal() * weighted;
  Eigen::Matrix<double, 5, 5> P = Q;
  Eigen::Matrix<double, 1, 5> F;
  for (int i = 0; i < 5000; ++i) {
    F = -(B.transpose() * P * A) / (weight(weights.torque_Nm) + B.dot(P * B));
    const Eigen::Matrix<double, 5, 5> next = Q + A.transpose() * P * (A + B * F);
    P = 0.5 * (next + next.transpose());
  }
  const Eigen::Matrix<double, 1, 5> carried = design.gain * design.sampled.topRows<4>();
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(carried(i), F(i), 1e-6 * F.cwiseAbs().maxCoeff()) << i;
}

// Reference: the recursion of the covariance from reading to reading.
TEST(Lqg, ItsFilterIsTheOneWithTheLeastCovariance) {
  const ServoJoint joint = joint_with(0.1);
  const LqgWeights weights = lqg_weights(joint);
  const LqgDesign design = design_lqg(joint, weights);
  const double velocity = weights.torque_noise_Nm * joint.period_s / joint.motor_inertia_kgm2;
  const double position = 0.5 * joint.period_s * velocity;
  Eigen::Matrix<double, 5, 1> deviation;
  deviation << position, velocity, position, velocity, weights.friction_change_Nm;
  const Eigen::Matrix<double, 5, 5> V = deviation.cwiseAbs2().asDiagonal();
  const double reading = std::pow(joint.encoder_resolution_rad, 2) / 12.0;
  Eigen::Matrix<double, 5, 5> P = V;
  Eigen::Matrix<double, 5, 1> L;
  for (int i = 0; i < 5000; ++i) {
    L = P.col(0) / (P(0, 0) + reading);
    const Eigen::Matrix<double, 5, 5> after = P - L * P.row(0);
    P = design.sampled * after * design.sampled.transpose() + V;
  }
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(design.filter(i), L(i), 1e-6 * std::abs(L(i))) << i;
}

/// Error of the link after one second under the peer, on the linear joint, from rest at 1 mrad.
double left_rad(const ServoJoint& joint, double load_Nm) {
  LqgPeer peer(joint);
  const Eigen::Matrix<double, 5, 5> sampled = design_lqg(joint, lqg_weights(joint)).sampled;
  Eigen::Matrix<double, 5, 1> state = 1e-3 * Eigen::Matrix<double, 5, 1>::Unit(0);
  std::array<double, LqgPeer::kMaxDelay + 1> torques_Nm{};
  peer.reset(state(0));
  for (int k = 0; k < 1000; ++k) {
    std::rotate(torques_Nm.begin(), torques_Nm.end() - 1, torques_Nm.end());
    torques_Nm.front() = peer.step({0.0, 0.0, 0.0}, state(0));
    state(4) = torques_Nm.at(static_cast<std::size_t>(joint.delay_periods)) - load_Nm;
    state.head<4>() = (sampled * state).eval().head<4>();
  }
  return std::abs(state(0) + state(2));
}

TEST(LqgPeer, IsStableOnTheJointItIsToldOfAndLeavesNothingOfAConstantLoad) {
  for (const double load_inertia_kgm2 : {0.03, 0.089, 0.267, 1.0})
    for (const double delay_periods : {0.0, 1.0, 2.0})
      for (const double load_Nm : {0.0, 5.0})
        EXPECT_LT(left_rad(joint_with(load_inertia_kgm2, delay_periods), load_Nm), 1e-7)
            << load_inertia_kgm2 << " kg.m2, delay " << delay_periods << ", " << load_Nm << " N.m";
}

TEST(LqgPeer, WantsNoMoreThanItsTorqueLimit) {
  const ServoJoint joint = joint_with(0.1);
  LqgPeer peer(joint);
  peer.reset(0.0);
  EXPECT_EQ(peer.step({1.0, 0.0, 0.0}, 0.0), joint.torque_limit_Nm);
  EXPECT_EQ(peer.step({-1.0, 0.0, 0.0}, 0.0), -joint.torque_limit_Nm);
}

}  // namespace
}  // namespace strainwave
