// When a motor that sticks beside its place, with the link on a spring, moves once more: the last counts of a motion. Each time the motor is
// at rest before it begins; its link may still swing, and add to the next. What so few small motions do not bring, none will: the rest is
// the integral's.
// So small a motion shows little but friction: where one falls short or goes too far, the next has more or less of it fed forward.
// Real-time safe. Motor's encoder, rad at the joint.
//
//   Open --------- too many, or too often in vain --------------------> Exhausted
//   Open --------- the reading moves where the motor should stand ----> Exhausted
//   any ---------- a new target, or a new start ----------------------> Open
#pragma once

#include <algorithm>

namespace strainwave {

class LinkCorrections {
 public:
  /// The motor is at rest after each of them, before the next begins.
  static constexpr int kMost = 20;
  /// Of one order, that brought nothing: load or friction are not what they are taken for.
  static constexpr int kMostInVain = 5;
  /// By no more than this share is the model's friction taken to be another.
  static constexpr double kMostFrictionDoubt = 0.4;
  /// Feedback that has asked for this share of the torque limit (control/chatter_monitor.h) means a joint that is not the
  /// model's: then small motions by that model do not help.
  static constexpr double kTrusted = 0.2;

  /// `period_s` > 0; `count_rad` > 0: what the reading cannot tell.
  LinkCorrections(double period_s, double count_rad) noexcept : period_s_(period_s), count_rad_(count_rad) {}

  /// A new start or target.
  void reset() noexcept {
    corrections_ = 0;
    friction_doubt_ = 0.0;
    trust_anew();
  }
  /// The target that there was, ordered again: what did not come off is not tried again.
  void trust_anew() noexcept { most_distrust_ = 0.0; }
  /// In [0, 1], of every period.
  void distrust(double share) noexcept { most_distrust_ = std::max(most_distrust_, share); }
  /// A motion is under way, an order's or one of these.
  void motion() noexcept { off_periods_ = rest_periods_ = 0; }

  /// What moves now, or moved last, was one of these and no order.
  bool begun() const noexcept { return corrections_ > 0; }
  /// Friction beyond the model's, as a share of it, that the corrections so far have shown: of the next one's feed-forward.
  double friction_doubt() const noexcept { return friction_doubt_; }

  /// A period of rest, `reading_rad` short of its place by `off_rad`, the same for `still_periods`. True: a correction begins.
  bool begins(double reading_rad, double off_rad, int still_periods) noexcept;

 private:
  void learn(double off_rad) noexcept;

  double period_s_;
  double count_rad_;
  int corrections_ = 0;  ///< kMost: exhausted
  int in_vain_ = 0;
  double corrected_from_rad_ = 0.0;  ///< what the last was to correct
  double friction_doubt_ = 0.0;
  double learning_ = 0.0;   ///< what a correction that brought nothing adds to that
  double last_left_ = 0.0;  ///< share of its way that the last but one left; negative: that it went too far
  double most_distrust_ = 0.0;
  int off_periods_ = 0;         ///< that the reading has been off on end
  int rest_periods_ = 0;        ///< since the motion has ended
  double stands_at_rad_ = 0.0;  ///< the reading soon after that
};

}  // namespace strainwave
