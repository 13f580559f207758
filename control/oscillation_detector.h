// SPDX-License-Identifier: BSD-3-Clause
// Detects an oscillation from reversals of the feedback torque that no plan orders. Real-time safe.
//
//   reversal     feedback beyond +limit after feedback beyond -limit, or vice versa, while the plan's torque keeps its sign
//   level'       -level / 1 s + 1 at each reversal
//   oscillates   from level >= 30 until reset(); for instance after 100 reversals per second for 0.36 s
//
// A joint with a wrong delay, inertia, stiffness or encoder side makes 40 to 400 reversals per second for as long as it is driven. A
// link of 1 kg m2 with 1 % damping swings at 160 reversals per second after a move, for a fifth of a second.
#pragma once

#include <cmath>
#include <utility>

namespace strainwave {

class OscillationDetector {
 public:
  /// `period_s` > 0.
  explicit OscillationDetector(double period_s) noexcept : period_s_(period_s) {}

  void reset() noexcept { *this = OscillationDetector(period_s_); }
  /// `feedback_Nm`: applied torque less `planned_Nm`; `limit_Nm` > 0: smaller swings are noise.
  void step(double feedback_Nm, double planned_Nm, double limit_Nm, int elapsed_periods) noexcept {
    const double kept = std::exp(-elapsed_periods * period_s_ / kMemory_s);
    level_ *= kept;
    swing_Nm_ *= kept;
    const int way = std::abs(planned_Nm) <= limit_Nm ? 0 : planned_Nm > 0.0 ? 1 : -1;
    if (way != 0 && way != std::exchange(planned_way_, way)) side_ = 0;
    if (std::abs(feedback_Nm) <= limit_Nm) return;
    swing_Nm_ = std::fmax(swing_Nm_, std::abs(feedback_Nm));
    const int side = feedback_Nm > 0.0 ? 1 : -1;
    if (side_ * side < 0) level_ += 1.0;
    side_ = side;
    oscillates_ = oscillates_ || level_ >= kMost;
  }

  bool oscillates() const noexcept { return oscillates_; }
  /// Evidence: the approximate rate at which the torque reversed, and how far it swung.
  double reversals_per_s() const noexcept { return level_ / kMemory_s; }
  double swing_Nm() const noexcept { return swing_Nm_; }

 private:
  static constexpr double kMemory_s = 1.0;
  static constexpr double kMost = 30.0;

  double period_s_;
  double level_ = 0.0;
  double swing_Nm_ = 0.0;
  int side_ = 0;
  int planned_way_ = 0;
  bool oscillates_ = false;
};

}  // namespace strainwave
