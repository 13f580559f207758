// The disturbance that a streamed motion's torque is made of: the observer's, which one count of the encoder shifts by as much as would have
// moved the joint by that count within the period. Where a joint turns round and breaks away every count does, and each of these shifts
// would be a torque step, and the next count its answer. What is fed forward follows slowly over such a distance and soon over more.
// Real-time safe. Joint side, SI.
//
//   |change| per period <= least * (1 + (distance / count)^2)      count = J resolution / T^2
#pragma once

#include <algorithm>

#include "control/joint_model.h"

namespace strainwave {

class EasedDisturbance {
 public:
  const JointDisturbance& value() const noexcept { return value_; }
  void jump_to(const JointDisturbance& estimated) noexcept { value_ = estimated; }
  /// `least_Nm` >= 0: may change each period however near it is; `count_Nm` > 0: the torque that moves the joint by a count in a period.
  void follow(const JointDisturbance& estimated, double least_Nm, double count_Nm,
              int elapsed_periods) noexcept {
    const auto ease = [&](double& eased_Nm, double estimated_Nm) {
      const double counts = (estimated_Nm - eased_Nm) / count_Nm;
      const double change_Nm = elapsed_periods * least_Nm * (1.0 + counts * counts);
      eased_Nm = std::clamp(estimated_Nm, eased_Nm - change_Nm, eased_Nm + change_Nm);
    };
    ease(value_.friction_offset_Nm, estimated.friction_offset_Nm);
    ease(value_.load_Nm, estimated.load_Nm);
  }

 private:
  JointDisturbance value_;
};

}  // namespace strainwave
