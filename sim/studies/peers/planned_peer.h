// SPDX-License-Identifier: BSD-3-Clause
// One of the peers under setpoints: the drive plans its motion itself. A mean over one period of the resonance smooths a trapezoidal
// velocity profile, so that it does not excite the resonance (Singer and Seering 1990). Real-time safe: torque_Nm(). Joint side, SI.
//
//   acceleration  0.6 of the peak torque over the inertia: the rest is for friction and the feedback
//   velocity      the speed at which the supply leaves 0.85 of the peak torque
#pragma once

#include <memory>
#include <vector>

#include "control/trajectory/moving_mean.h"
#include "sim/studies/contenders.h"
#include "sim/studies/peers/servo_peer.h"

namespace strainwave {

class PlannedPeer final : public LoopController {
 public:
  PlannedPeer(std::unique_ptr<ServoPeer> peer, const JointPlantConfig& plant);
  double torque_Nm(const LoopSample& sample) noexcept override;
  void reset() noexcept override { started_ = false; }

 private:
  std::unique_ptr<ServoPeer> peer_;
  double period_s_;
  ReferenceShaper shaper_;
  MovingMean mean_;
  double last_rad_ = 0.0;         ///< the plan's position at the last sample ...
  double before_last_rad_ = 0.0;  ///< ... and at the one before
  bool started_ = false;
};

/// The alternatives of a user: "cascade", "cascade with feed-forward", "cascade with feed-forward and notch",
/// "disturbance observer", "LQG". Each needs a joint with a spring and a torque limit.
std::vector<Contender> peer_contenders();

}  // namespace strainwave
