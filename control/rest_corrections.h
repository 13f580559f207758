// SPDX-License-Identifier: BSD-3-Clause
// Corrects the last counts: a motor that sticks off its target makes a few small planned motions from where it stands. Their result
// mainly shows friction: after a motion that falls short the next one feeds forward more of it, after one that goes too far less. The
// integral removes any remaining error. Real-time safe. Encoder's side, rad at the joint.
#pragma once

#include <algorithm>
#include <cmath>

namespace strainwave {

class RestCorrections {
 public:
  /// A motor at standstill for this long has stopped: a count flickers for less, and links above 50 Hz swing once in less.
  static constexpr double kStands_s = 0.02;
  /// A motor farther off than this is not at its target: the reading cannot resolve one count, and there is rounding.
  static constexpr double kAtPlaceCounts = 1.01;

  /// `period_s` > 0; `count_rad` > 0: the reading's resolution.
  RestCorrections(double period_s, double count_rad) noexcept
      : off_limit_(static_cast<int>(std::lround(kStands_s / period_s))), count_rad_(count_rad) {}

  /// A new order begins.
  void reset() noexcept { *this = RestCorrections(off_limit_, count_rad_); }
  /// A motion is under way: an ordered one or a correction.
  void motion() noexcept { off_periods_ = 0; }
  /// Whether the present or the last motion is a correction.
  bool begun() const noexcept { return corrections_ > 0; }
  int count() const noexcept { return corrections_; }
  /// Friction beyond the known friction, as a share of it, that the corrections have shown so far.
  double friction_share() const noexcept { return friction_share_; }

  /// One period at rest, `off_rad` short of the target, with a constant reading for `still_periods`. Returns true if a correction begins.
  bool begins(double off_rad, int still_periods) noexcept {
    const double off_counts = std::abs(off_rad) / count_rad_;
    off_periods_ = off_counts > kAtPlaceCounts && off_counts < kPushedCounts ? off_periods_ + 1 : 0;
    if (off_periods_ < off_limit_ || still_periods < kStillPeriods || corrections_ >= kMost) return false;
    if (begun()) learn(std::clamp(off_rad / from_off_rad_, -1.0, 1.0));
    from_off_rad_ = off_rad;
    ++corrections_;
    off_periods_ = 0;
    return true;
  }

 private:
  /// By `strainwave-sim flexible --wrong`: with 6, more joints with a wrong load stay off their target. With 9 or more, the first joints
  /// with a wrong delay oscillate until they are switched off.
  static constexpr int kMost = 8;
  /// Friction cannot hold a motor this far off. Something has pushed it: the law and the learned load bring it back.
  static constexpr double kPushedCounts = 250.0;
  /// A motor that needs this many periods for a count stops in less than a count.
  static constexpr int kStillPeriods = 3;
  /// Share of the friction that a correction without effect adds; halved whenever a correction errs to the other side.
  static constexpr double kLearning = 0.2;
  static constexpr double kMostShare = 0.4;

  RestCorrections(int off_limit, double count_rad) noexcept : off_limit_(off_limit), count_rad_(count_rad) {}

  void learn(double left) noexcept {
    if (left * last_left_ < 0.0) learning_ *= 0.5;
    last_left_ = left;
    friction_share_ = std::clamp(friction_share_ + learning_ * left, -kMostShare, kMostShare);
  }

  int off_limit_;
  double count_rad_;
  int corrections_ = 0;
  int off_periods_ = 0;
  double from_off_rad_ = 0.0;
  double friction_share_ = 0.0;
  double learning_ = kLearning;
  double last_left_ = 0.0;  ///< remaining share of the last correction's distance; negative: it went too far
};

}  // namespace strainwave
