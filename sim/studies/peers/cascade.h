// SPDX-License-Identifier: BSD-3-Clause
// The cascade of a servo drive: a proportional position loop around a proportional-integral velocity loop, with or without velocity and
// acceleration fed forward, with or without a notch in its torque. Real-time safe. Sources: the symmetrical optimum
// (sim/studies/peers/servo_peer.h), whose integral time is twice the reciprocal of its crossover; position loop at a quarter of the
// velocity loop, within the makers' "at least twice" (Kinco CD420 manual, 8.1).
//
//   wv = velocity bandwidth,  kp = wv / 4,  Kv = J wv,  Ti = 2 / wv
//   v  = kp (p_r - p) + v_r
//   u  = notch of  Kv (v - w + 1/Ti integral (v - w)) + J a_r       v_r and a_r: only fed forward
#pragma once

#include <memory>
#include <optional>

#include "sim/studies/loop_controllers.h"
#include "sim/studies/peers/notch_filter.h"
#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

class CascadePeer final : public ServoPeer {
 public:
  CascadePeer(const ServoJoint& joint, bool feedforward, std::optional<NotchFilter> notch = {}) noexcept;
  double step(const Reference& reference, double joint_position_rad) noexcept override;
  void reset(double joint_position_rad) noexcept override;

 private:
  ServoJoint joint_;
  double bandwidth_rad_s_;
  double share_;  ///< of the reference's derivatives that is fed forward
  BackwardDifference difference_;
  std::optional<NotchFilter> notch_;
  double integral_Nm_ = 0.0;
};

/// With feed-forward and a notch at the resonance. It is a tenth as wide: the narrowest of the drives that are named in notch_filter.h.
/// Of a tenth to the whole it is the best on the grid of docs/flexible-joint.md, for a wider one delays the loop that damps the swing.
std::unique_ptr<CascadePeer> notched_cascade(ServoJoint joint);

}  // namespace strainwave
