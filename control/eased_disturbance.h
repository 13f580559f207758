// The disturbance that a streamed motion's torque is made of: the observer's, which one count of the encoder shifts by as much as would have
// moved the joint by that count within the period. Where a joint turns round and breaks away every count does, and each of these shifts
// would be a torque step, and the next count its answer. What is fed forward follows slowly over such a distance and soon over more.
// Real-time safe. Joint side, SI.
//
//   each of its parts by EasedTorque, least as told, doubled at count = J resolution / T^2
#pragma once

#include "control/eased_torque.h"
#include "control/joint_model.h"

namespace strainwave {

class EasedDisturbance {
 public:
  JointDisturbance value() const noexcept { return {friction_offset_.value_Nm(), load_.value_Nm()}; }
  void jump_to(const JointDisturbance& estimated) noexcept {
    friction_offset_.jump_to(estimated.friction_offset_Nm);
    load_.jump_to(estimated.load_Nm);
  }
  /// `least_Nm` >= 0: may change each period however near it is; `count_Nm` > 0: the torque that moves the joint by a count in a period.
  void follow(const JointDisturbance& estimated, double least_Nm, double count_Nm,
              int elapsed_periods) noexcept {
    friction_offset_.follow(estimated.friction_offset_Nm, least_Nm, count_Nm, elapsed_periods);
    load_.follow(estimated.load_Nm, least_Nm, count_Nm, elapsed_periods);
  }

 private:
  EasedTorque friction_offset_;
  EasedTorque load_;
};

}  // namespace strainwave
