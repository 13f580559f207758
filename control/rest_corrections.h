// SPDX-License-Identifier: BSD-3-Clause
// The last counts: a motor that sticks beside its place makes a small planned motion from where it stands, a few times at most. Such a
// motion shows little but friction: where one falls short, the next feeds forward more of it, where one goes too far, less. What
// these do not bring is the integral's. Real-time safe. Encoder's side, rad at the joint.
#pragma once

#include <algorithm>
#include <cmath>

namespace strainwave {

class RestCorrections {
 public:
  /// A motor that is seen to stand for so long does: longer than a count flickers, and than most links swing once behind it (20 to 80 Hz).
  static constexpr double kStands_s = 0.02;
  /// A motor that is off by more is not at its place: one count is what the reading cannot tell, and there is rounding.
  static constexpr double kAtPlaceCounts = 1.01;

  /// `period_s` > 0; `count_rad` > 0: what the reading cannot tell.
  RestCorrections(double period_s, double count_rad) noexcept
      : off_limit_(static_cast<int>(std::lround(kStands_s / period_s))), count_rad_(count_rad) {}

  /// A new order.
  void reset() noexcept { *this = RestCorrections(off_limit_, count_rad_); }
  /// A motion is under way, an order's or one of these.
  void motion() noexcept { off_periods_ = 0; }
  /// What moves now, or moved last, was one of these and no order.
  bool begun() const noexcept { return corrections_ > 0; }
  int count() const noexcept { return corrections_; }
  /// Friction besides what is known, as a share of it, that the corrections so far have shown.
  double friction_share() const noexcept { return friction_share_; }

  /// A period of rest, short of its place by `off_rad`, the reading the same for `still_periods`. True: a correction begins.
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
  /// `strainwave-sim flexible --wrong`: with 6 more joints of a wrong load stand beside their place; with 9 or more the first oscillate at
  /// a wrong delay, until they are switched off.
  static constexpr int kMost = 8;
  /// A motor that friction holds this far off does not exist: it is pushed, and the law and the learned load bring it back.
  static constexpr double kPushedCounts = 250.0;
  /// At one count in so many periods a motor stops in less than a count.
  static constexpr int kStillPeriods = 3;
  /// A correction that brings nothing adds this share of the friction; half of it from when one has gone too far.
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
  double last_left_ = 0.0;  ///< share of its way that the last correction left; negative: it went too far
};

}  // namespace strainwave
