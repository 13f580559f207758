// SPDX-License-Identifier: BSD-3-Clause
// Linear quadratic Gaussian control of both masses from the motor's encoder: a Kalman filter of the joint with its spring, to which
// friction and load are a torque at the motor, and the optimal regulator of the filter's estimate. Real-time safe: step().
// Sources: Anderson and Moore, "Optimal Control: Linear Quadratic Methods" (1990), chapters 7 and 8; weights as Bryson and Ho (1975) set
// them, each one over the square of what is acceptable.
//
//   x  = [ thm, wm, s, v ],   s = thl - thm,   v = s'         sampled and held as in control/table/spring_plant.h, without friction
//   x+ = A x + B (u(d periods ago) + f),   f+ = f             f: minus what friction and load take
//   y  = thm
//   planned   [ p - s_r, v_r - s_r', s_r, s_r' ],   s_r = -Jl a_r / K       the link on the reference, the motor ahead by the wind-up
//   e  = planned - estimated, carried over the delay under the torque under way:  e+ = A e + B (J a_r - u - f)
//   u  = J a_r - f - F e                                      F: least sum of weighted squares of [ thl, wl, thm, wm ] and u
//
// With e carried over the delay this is the optimum of the joint that has the torque under way among its states: what is commanded now
// changes nothing until it acts.
#pragma once

#include <Eigen/Core>
#include <array>

#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

/// All > 0. Of each error what is acceptable for `torque_Nm`, and the noise in the Kalman filter's model: standard deviations.
struct LqgWeights {
  double torque_Nm = 0.0;
  double link_position_rad = 0.0;
  double motor_position_rad = 0.0;
  double velocity_rad_s = 0.0;      ///< of both
  double friction_change_Nm = 0.0;  ///< of f from one period to the next
  double torque_noise_Nm = 0.0;     ///< at the motor besides, from one period to the next
};

struct LqgDesign {
  Eigen::Matrix<double, 5, 5> sampled;  ///< [ A B; 0 1 ], of [ x; f ]
  Eigen::RowVector4d gain;              ///< F
  Eigen::Matrix<double, 5, 1>
      filter;  ///< change of [ x; f ] for each rad that the encoder reads more than was expected
};

/// The best of those tried on the grid of docs/flexible-joint.md.
LqgWeights lqg_weights(const ServoJoint& joint) noexcept;
/// Of a joint with a spring and an encoder that counts. Throws InputError where there is no solution.
LqgDesign design_lqg(const ServoJoint& joint, const LqgWeights& weights);

class LqgPeer final : public ServoPeer {
 public:
  /// Of a delay the nearest whole number of periods is taken, 0..kMaxDelay.
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
  std::array<double, kMaxDelay + 1> torques_Nm_{};            ///< commanded, the newest first
  std::array<double, kMaxDelay + 2> accelerations_rad_s2_{};  ///< a_r of when those act
};

}  // namespace strainwave
