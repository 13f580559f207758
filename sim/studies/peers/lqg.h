// SPDX-License-Identifier: BSD-3-Clause
// Linear quadratic Gaussian control of both masses from the motor's encoder. A Kalman filter estimates the state of
// the joint with its spring, with friction and load as a torque at the motor. The optimal regulator uses the
// estimate. Real-time safe: step(). Sources: Anderson and Moore, "Optimal Control: Linear Quadratic Methods" (1990),
// chapters 7 and 8; weights by Bryson and Ho (1975), each one over the square of the acceptable value.
//
//   x  = [ thm, wm, s, v ],   s = thl - thm,   v = s'         sampled and held as in control/table/spring_plant.h, without friction
//   x+ = A x + B (u(d periods ago) + f),   f+ = f             f: minus the torque of friction and load
//   y  = thm
//   planned   [ p - s_r, v_r - s_r', s_r, s_r' ],   s_r = -Jl a_r / K       the link on the reference, the motor ahead by the wind-up
//   e  = planned - estimated, predicted over the delay with the torques under way:  e+ = A e + B (J a_r - u - f)
//   u  = J a_r - f - F e                                      F: least sum of weighted squares of [ thl, wl, thm, wm ] and u
//
// A command changes nothing until it acts. With e predicted over the delay, this law is therefore the optimum
// for the joint whose states include the torques under way.
#pragma once

#include <Eigen/Core>
#include <array>

#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

/// All > 0. The acceptable size of each error for `torque_Nm`, and the standard deviations of the noise in the Kalman filter's model.
struct LqgWeights {
  double torque_Nm = 0.0;
  double link_position_rad = 0.0;
  double motor_position_rad = 0.0;
  double velocity_rad_s = 0.0;      ///< of motor and link
  double friction_change_Nm = 0.0;  ///< change of f from one period to the next
  double torque_noise_Nm = 0.0;     ///< additional noise at the motor, from one period to the next
};

struct LqgDesign {
  Eigen::Matrix<double, 5, 5> sampled;  ///< [ A B; 0 1 ], of [ x; f ]
  Eigen::RowVector4d gain;              ///< F
  Eigen::Matrix<double, 5, 1> filter;   ///< correction of [ x; f ] per rad between reading and prediction
};

/// The best weights of those that were tried on the grid of docs/flexible-joint.md.
LqgWeights lqg_weights(const ServoJoint& joint) noexcept;
/// The design for a joint with a spring and an encoder of finite resolution. Throws InputError if there is no solution.
LqgDesign design_lqg(const ServoJoint& joint, const LqgWeights& weights);

class LqgPeer final : public ServoPeer {
 public:
  /// Rounds the delay to a whole number of periods, which must be in 0..kMaxDelay.
  LqgPeer(const ServoJoint& joint, const LqgWeights& weights);
  explicit LqgPeer(const ServoJoint& joint) : LqgPeer(joint, lqg_weights(joint)) {}
  double step(const Reference& reference, double joint_position_rad) noexcept override;
  void reset(double joint_position_rad) noexcept override;

  static constexpr std::size_t kMaxDelay = 4;

 private:
  using State = Eigen::Matrix<double, 5, 1>;
  Eigen::Vector4d planned(const Reference& reference) const noexcept;

  ServoJoint joint_;
  LqgDesign design_;
  std::size_t delay_;
  State expected_ = State::Zero();                            ///< [ x; f ] at the next reading
  std::array<double, kMaxDelay + 1> torques_Nm_{};            ///< commanded, newest first
  std::array<double, kMaxDelay + 2> accelerations_rad_s2_{};  ///< a_r of the periods in which those act
};

}  // namespace strainwave
