// How a torque goes on from one law to another without a step: the new law's begins with the difference to the last torque, which leaves. Of a
// motion that goes on within some swings of a spring. Of a joint that is to rest so that what it does to the joint's momentum it undoes: that is
// displaced by left T0^2 / J at most, however little friction holds it, and not thrown. Real-time safe. Joint side.
//
//   torque = law + left,   left_0 = last torque - law_0
//   motion   left_k = left_0 r^k,                        r = 1 - T / 10 ms
//   rest     left_k = left_0 (1 - k (1 - r) / r) r^k,    r = 1 - T / T0,   T0 = 5 ms, five periods at least;   sum of left_k = 0
#pragma once

#include <algorithm>
#include <optional>

namespace strainwave {

class Handover {
 public:
  /// `period_s` > 0.
  explicit Handover(double period_s) noexcept : period_s_(period_s) {}

  /// Nothing is handed over.
  void reset() noexcept {
    last_torque_Nm_.reset();
    decaying_Nm_ = ramped_Nm_ = 0.0;
  }
  /// The next period begins with `torque_Nm`, the last that was applied. `moves`: of a motion that goes on.
  void begin(double torque_Nm, bool moves) noexcept {
    last_torque_Nm_ = torque_Nm;
    leaves_ = moves ? std::min(1.0, period_s_ / kMotion_s) : std::min(kMostLeaves, period_s_ / kRest_s);
    undone_ = moves ? 0.0 : 1.0;
  }
  /// The torque of a period in which the law asks for `law_Nm`.
  double torque_Nm(double law_Nm) noexcept {
    if (last_torque_Nm_) {
      decaying_Nm_ = *last_torque_Nm_ - law_Nm;
      ramped_Nm_ = 0.0;
    }
    last_torque_Nm_.reset();
    const double torque_Nm = law_Nm + decaying_Nm_ - ramped_Nm_;
    ramped_Nm_ = (1.0 - leaves_) * ramped_Nm_ + undone_ * leaves_ * decaying_Nm_;
    decaying_Nm_ *= 1.0 - leaves_;
    return torque_Nm;
  }

 private:
  static constexpr double kMotion_s = 0.01;
  static constexpr double kRest_s = 0.005;
  static constexpr double kMostLeaves = 0.2;  // of it, in a period
  double period_s_;
  double leaves_ = 1.0;                   ///< 1 - r
  double undone_ = 0.0;                   ///< share of the impulse
  std::optional<double> last_torque_Nm_;  ///< until the first period
  double decaying_Nm_ = 0.0;              ///< r^k of the difference
  double ramped_Nm_ = 0.0;                ///< k (1 - r) / r r^k of it
};

}  // namespace strainwave
