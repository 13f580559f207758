// How a torque goes on from one law to another without a step: the new law's begins with the difference to the last torque, which it leaves
// within some swings of a spring, so that it is no step, and no later, so that it does not move the joint.
// Real-time safe. Joint side.
//
//   torque = law + left
//   left'  = left (1 - T / 10 ms),   left = last torque - law in the first period
#pragma once

#include <algorithm>
#include <optional>

namespace strainwave {

class Handover {
 public:
  /// `period_s` > 0.
  explicit Handover(double period_s) noexcept : kept_(1.0 - std::min(1.0, period_s / kTime_s)) {}

  /// Nothing is handed over.
  void reset() noexcept {
    last_torque_Nm_.reset();
    left_Nm_ = 0.0;
  }
  /// The next period begins with `torque_Nm`, the last that was applied.
  void begin(double torque_Nm) noexcept { last_torque_Nm_ = torque_Nm; }
  /// The torque of a period in which the law asks for `law_Nm`. Of the difference that it begins with no more is taken than `most_Nm` >= 0.
  double torque_Nm(double law_Nm, double most_Nm) noexcept {
    if (last_torque_Nm_) left_Nm_ = std::clamp(*last_torque_Nm_ - law_Nm, -most_Nm, most_Nm);
    last_torque_Nm_.reset();
    const double torque_Nm = law_Nm + left_Nm_;
    left_Nm_ *= kept_;
    return torque_Nm;
  }

 private:
  static constexpr double kTime_s = 0.01;
  double kept_;
  std::optional<double> last_torque_Nm_;  ///< until the first period
  double left_Nm_ = 0.0;
};

}  // namespace strainwave
