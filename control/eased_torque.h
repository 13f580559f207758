// A torque that follows another slowly over a small distance and soon over a great one: what one count of an encoder shifts, and the next may
// shift back, makes no step; what several say is there as soon. Real-time safe. Joint side, SI.
//
//   |change| per period <= least * (1 + (distance / doubled)^2)
#pragma once

#include <algorithm>

namespace strainwave {

class EasedTorque {
 public:
  double value_Nm() const noexcept { return value_Nm_; }
  void jump_to(double torque_Nm) noexcept { value_Nm_ = torque_Nm; }
  /// `least_Nm` >= 0: may change each period however near it is; `doubled_Nm` > 0: the distance over which that is twice as much.
  void follow(double torque_Nm, double least_Nm, double doubled_Nm, int elapsed_periods) noexcept {
    const double doublings = (torque_Nm - value_Nm_) / doubled_Nm;
    const double change_Nm = elapsed_periods * least_Nm * (1.0 + doublings * doublings);
    value_Nm_ = std::clamp(torque_Nm, value_Nm_ - change_Nm, value_Nm_ + change_Nm);
  }

 private:
  double value_Nm_ = 0.0;
};

}  // namespace strainwave
