// SPDX-License-Identifier: BSD-3-Clause
// The cascade of a servo drive: a proportional position loop around a proportional-integral velocity loop. Feed-forward of
// velocity and acceleration, and a notch for the torque, are optional. Real-time safe. Sources: the symmetrical optimum
// (sim/studies/peers/servo_peer.h), whose integral time is twice the reciprocal of its crossover. The position loop has a
// quarter of the velocity loop's bandwidth, within the makers' "at least twice" (Kinco CD420 manual, 8.1).
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
  double share_;  ///< share of the reference's derivatives that is fed forward
  BackwardDifference difference_;
  std::optional<NotchFilter> notch_;
  double integral_Nm_ = 0.0;
};

/// With feed-forward and a notch at the resonance. Its relative width of 0.1 is the narrowest of the drives in notch_filter.h. Of
/// widths from 0.1 to 1 it is the best on the grid of docs/flexible-joint.md: a wider one delays the loop that damps the swing.
std::unique_ptr<CascadePeer> notched_cascade(ServoJoint joint);

}  // namespace strainwave
