// The cascade of a servo drive: a proportional position loop around a proportional-integral velocity loop, with or without velocity and
// acceleration fed forward. Real-time safe. Sources: the symmetrical optimum (sim/studies/peers/servo_peer.h), whose integral time is
// twice the reciprocal of its crossover; position loop at a quarter of the velocity loop, within the makers' "at least twice" (Kinco
// CD420 manual, 8.1).
//
//   wv = velocity bandwidth,  kp = wv / 4,  Kv = J wv,  Ti = 2 / wv
//   v  = kp (p_r - p) + v_r
//   u  = Kv (v - w + 1/Ti integral (v - w)) + J a_r       v_r and a_r: only fed forward
#pragma once

#include "sim/studies/loop_controllers.h"
#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

class CascadePeer final : public ServoPeer {
 public:
  CascadePeer(const ServoJoint& joint, bool feedforward) noexcept;
  double step(const Reference& reference, double joint_position_rad) noexcept override;
  void reset(double joint_position_rad) noexcept override;

 private:
  ServoJoint joint_;
  double bandwidth_rad_s_;
  double share_;  ///< of the reference's derivatives that is fed forward
  BackwardDifference difference_;
  double integral_Nm_ = 0.0;
};

}  // namespace strainwave
