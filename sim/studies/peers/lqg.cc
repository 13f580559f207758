// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/lqg.h"

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/input_error.h"
#include "control/joint/riccati.h"
#include "control/table/spring_plant.h"

namespace strainwave {

namespace {

// The weights accept errors for this share of the torque limit. The errors are these shares of the wind-up
// that the torque causes, and of the speed at which that wind-up swings.
constexpr double kTorqueShare = 0.1;
constexpr double kLinkShare = 0.4;
constexpr double kMotorShare = 1.6;
constexpr double kSpeedShare = 0.15;
// Friction reverses within a period if the joint does.
constexpr double kFrictionChange_Nm = 5.0;
constexpr double kTorqueNoise_Nm = 0.9;

double squared(double value) noexcept {
  return value * value;
}

double link_inertia_kgm2(const ServoJoint& joint) noexcept {
  return joint.inertia_kgm2 - joint.motor_inertia_kgm2;
}

// [ thl, wl, thm, wm ] = T x: the weighted quantities.
Eigen::Matrix4d from_state() {
  Eigen::Matrix4d T;
  T << 1.0, 0.0, 1.0, 0.0,  //
      0.0, 1.0, 0.0, 1.0,   //
      1.0, 0.0, 0.0, 0.0,   //
      0.0, 1.0, 0.0, 0.0;
  return T;
}

Eigen::RowVector4d regulator(const Eigen::Matrix<double, 5, 5>& sampled, const LqgWeights& weights) {
  const Eigen::Matrix4d T = from_state();
  const Eigen::Matrix4d A = T * sampled.topLeftCorner<4, 4>() * T.inverse();
  const Eigen::Vector4d B = T * sampled.topRightCorner<4, 1>();
  const Eigen::Vector4d W(1.0 / squared(weights.link_position_rad), 1.0 / squared(weights.velocity_rad_s),
                          1.0 / squared(weights.motor_position_rad), 1.0 / squared(weights.velocity_rad_s));
  const double R = 1.0 / squared(weights.torque_Nm);
  const auto P = solve_riccati(A, B, W, R);
  if (!P) throw InputError("LQG: the regulator's Riccati equation has no solution");
  return -(B.transpose() * *P * A) / (R + B.dot(*P * B)) * T;
}

// The filter's Riccati equation is that of the regulator for the transposed plant.
Eigen::VectorXd kalman(const Eigen::Matrix<double, 5, 5>& sampled, const ServoJoint& joint,
                       const LqgWeights& weights) {
  const double velocity_rad_s = weights.torque_noise_Nm * joint.period_s / joint.motor_inertia_kgm2;
  const double position_rad = 0.5 * velocity_rad_s * joint.period_s;
  Eigen::VectorXd noise(5);
  noise << squared(position_rad), squared(velocity_rad_s), squared(position_rad), squared(velocity_rad_s),
      squared(weights.friction_change_Nm);
  const double reading = squared(joint.encoder_resolution_rad) / 12.0;
  const auto P = solve_riccati(sampled.transpose(), Eigen::VectorXd::Unit(5, 0), noise, reading);
  if (!P) throw InputError("LQG: the filter's Riccati equation has no solution");
  return P->col(0) / ((*P)(0, 0) + reading);
}

}  // namespace

LqgWeights lqg_weights(const ServoJoint& joint) noexcept {
  LqgWeights weights;
  weights.torque_Nm = kTorqueShare * joint.torque_limit_Nm;
  const double wind_up_rad = weights.torque_Nm / joint.stiffness_Nm_rad;
  weights.link_position_rad = kLinkShare * wind_up_rad;
  weights.motor_position_rad = kMotorShare * wind_up_rad;
  weights.velocity_rad_s = kSpeedShare * wind_up_rad * joint.resonance_rad_s;
  weights.friction_change_Nm = kFrictionChange_Nm;
  weights.torque_noise_Nm = kTorqueNoise_Nm;
  return weights;
}

LqgDesign design_lqg(const ServoJoint& joint, const LqgWeights& weights) {
  const SpringPlant plant{joint.motor_inertia_kgm2, link_inertia_kgm2(joint), joint.stiffness_Nm_rad,
                          joint.damping_Nms_rad, 0.0};
  LqgDesign design;
  design.sampled = spring_exponential(spring_generator(plant, joint.period_s)).value;
  design.gain = regulator(design.sampled, weights);
  design.filter = kalman(design.sampled, joint, weights);
  return design;
}

LqgPeer::LqgPeer(const ServoJoint& joint, const LqgWeights& weights)
    : joint_(joint),
      design_(design_lqg(joint, weights)),
      delay_(static_cast<std::size_t>(std::lround(joint.delay_periods))) {
  assert(delay_ <= kMaxDelay);
}

// The reference's velocity belongs to the middle of the last period; its acceleration, which gives the wind-up, to the acting torque.
Eigen::Vector4d LqgPeer::planned(const Reference& reference) const noexcept {
  const double now_rad_s2 = accelerations_rad_s2_[delay_];
  const double before_rad_s2 = accelerations_rad_s2_[delay_ + 1];
  const double velocity_rad_s = reference.velocity_rad_s + 0.5 * joint_.period_s * before_rad_s2;
  const double angle_per_rad_s2 = -link_inertia_kgm2(joint_) / joint_.stiffness_Nm_rad;
  const double angle_rad = angle_per_rad_s2 * now_rad_s2;
  const double angle_rad_s = angle_per_rad_s2 * (now_rad_s2 - before_rad_s2) / joint_.period_s;
  return {reference.position_rad - angle_rad, velocity_rad_s - angle_rad_s, angle_rad, angle_rad_s};
}

double LqgPeer::step(const Reference& reference, double joint_position_rad) noexcept {
  std::rotate(accelerations_rad_s2_.begin(), accelerations_rad_s2_.end() - 1, accelerations_rad_s2_.end());
  accelerations_rad_s2_.front() = reference.acceleration_rad_s2;
  State estimated = expected_ + design_.filter * (joint_position_rad - expected_(0));
  const double friction_Nm = estimated(4);
  const Eigen::Matrix4d A = design_.sampled.topLeftCorner<4, 4>();
  const Eigen::Vector4d B = design_.sampled.topRightCorner<4, 1>();
  Eigen::Vector4d error = planned(reference) - estimated.head<4>();
  for (std::size_t ago = delay_; ago > 0; --ago) {
    const double planned_Nm = joint_.inertia_kgm2 * accelerations_rad_s2_[ago];
    error = A * error + B * (planned_Nm - torques_Nm_[ago - 1] - friction_Nm);
  }
  const double wanted_Nm =
      joint_.inertia_kgm2 * reference.acceleration_rad_s2 - friction_Nm - design_.gain.dot(error);
  std::rotate(torques_Nm_.begin(), torques_Nm_.end() - 1, torques_Nm_.end());
  torques_Nm_.front() = std::clamp(wanted_Nm, -joint_.torque_limit_Nm, joint_.torque_limit_Nm);
  State acting = estimated;
  acting(4) += torques_Nm_[delay_];
  expected_ = design_.sampled * acting;
  expected_(4) = friction_Nm;
  return torques_Nm_.front();
}

void LqgPeer::reset(double joint_position_rad) noexcept {
  expected_ = joint_position_rad * State::Unit(0);
  torques_Nm_.fill(0.0);
  accelerations_rad_s2_.fill(0.0);
}

}  // namespace strainwave
