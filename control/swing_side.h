// When a joint swings over from one side of its reference to the other, beyond the last counts: what a hand or a tap makes is over soon, what the
// law makes goes on. Real-time safe.
//
//   side    of the reference, on which the joint was last farther off than `near`
//   forgotten once it has been nearer for 0.1 s: it came back, and its next swing is another's
#pragma once

#include <cmath>
#include <utility>

namespace strainwave {

class SwingSide {
 public:
  /// `period_s` > 0.
  explicit SwingSide(double period_s) noexcept : period_s_(period_s) {}

  /// One period, in which the joint is `off_rad` beyond its reference. True in the period in which it has come over.
  bool swings_over(double off_rad, double near_rad) noexcept {
    if (std::abs(off_rad) <= near_rad) {
      near_s_ += period_s_;
      if (near_s_ > kForgets_s) side_ = 0;
      return false;
    }
    near_s_ = 0.0;
    const int side = off_rad > 0.0 ? 1 : -1;
    return std::exchange(side_, side) == -side;
  }

 private:
  static constexpr double kForgets_s = 0.1;
  double period_s_;
  int side_ = 0;         ///< 0: none
  double near_s_ = 0.0;  ///< since when it is nearer
};

}  // namespace strainwave
