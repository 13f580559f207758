// SPDX-License-Identifier: BSD-3-Clause
// A disturbance observer on top of a proportional-derivative controller. It estimates and compensates the torque, including
// friction, that makes the motion deviate from that of the nominal inertia. Real-time safe. Source: Ohnishi, Shibata and
// Murakami (1996), "Motion control for advanced mechatronics"; gains by sim/studies/peers/servo_peer.h.
//
//   d    = Q (u - J w'),  Q = g / (s + g)               as  Q (u + g J w) - g J w: no acceleration is needed
//   u    = J (a_r + kv (w_r - w) + kp (p_r - p)) + d
//   kv   = velocity bandwidth,  kp = kv^2 / 4           both poles of the position at kv / 2
//   g    = kv / 2                                       the reciprocal of four small times, as the symmetrical optimum's integral
#pragma once

#include "sim/studies/loop_controllers.h"
#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

class DisturbanceObserverPeer final : public ServoPeer {
 public:
  explicit DisturbanceObserverPeer(const ServoJoint& joint) noexcept;
  double step(const Reference& reference, double joint_position_rad) noexcept override;
  void reset(double joint_position_rad) noexcept override;

 private:
  ServoJoint joint_;
  double bandwidth_rad_s_;
  double observer_rad_s_;
  double observer_share_;  ///< gain of Q per period
  BackwardDifference difference_;
  double filtered_Nm_ = 0.0;
  double applied_Nm_ = 0.0;  ///< torque of the last period
  double acting_Nm_ = 0.0;   ///< torque of the period before, which acts if the delay is one period
};

}  // namespace strainwave
