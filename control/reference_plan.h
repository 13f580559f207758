// An order, a target or a stream, as a reference within limits: the shaper's motion (control/reference_shaper.h), or the mean of it where the jerk is
// limited or moves are eased (control/jerk_limit.h). Real-time safe. Joint side, SI.
//
//   plain      the shaper's motion itself
//   limited    its mean, always
//   eased      its mean in a move or path that begins at rest, and in what follows it until a stream begins at rest or the joint starts: a stream
//              tells how it moves by itself. One that begins on the way goes on eased
//   plain_until_eased   its mean from ease_from() on, which takes a motion up that is under way, until a stream begins at rest or the joint starts
//
// While it is a mean it lags by lag_s(): the shaper is that much ahead, and goes on from where the mean is wherever one takes the other's place.
#pragma once

#include "control/jerk_limit.h"
#include "control/reference_shaper.h"

namespace strainwave {

class ReferencePlan {
 public:
  static ReferencePlan plain(double period_s) noexcept {
    return {period_s, JerkLimit::spread_over(period_s, period_s), Mean::kNever};
  }
  static ReferencePlan plain_until_eased(double period_s, const JerkLimit& mean) noexcept {
    return {period_s, mean, Mean::kNever};
  }
  static ReferencePlan limited(double period_s, const JerkLimit& limit) noexcept {
    return {period_s, limit, Mean::kAlways};
  }
  static ReferencePlan eased(double period_s, const JerkLimit& mean) noexcept {
    return {period_s, mean, Mean::kPaused};
  }

  /// From now on; see ReferenceShaper.
  void set_limits(const MotionLimits& limits) noexcept { shaper_.set_limits(limits); }
  /// Begins here: what can be stopped is, and nothing is eased.
  void begin(double position_rad, double velocity_rad_s) noexcept;
  /// Goes on from here to the target that it has.
  void go_on_from(double position_rad, double velocity_rad_s) noexcept;
  /// The same, eased from here on.
  void ease_from(double position_rad, double velocity_rad_s) noexcept;
  void set_target(double position_rad) noexcept { shaper_.set_target(position_rad); }
  void stop() noexcept { shaper_.stop(); }
  /// Takes the target at once, as a step.
  void jump() noexcept { shaper_.jump(); }
  /// Whether a move that begins now is to be eased and is not yet.
  bool wants_easing() const noexcept { return mean_is_ == Mean::kPaused && shaper_.at_target(); }
  void ease() noexcept;
  void end_easing() noexcept;
  /// A path begins: eased where moves are.
  void begin_path() noexcept;

  /// The reference for this sample; the plan then advances by a period.
  Reference step() noexcept { return averaged(shaper_.step()); }
  /// The same after a target that moves, inside `range`.
  Reference follow(const MovingTarget& target, const PositionRange& range) noexcept {
    return averaged(shaper_.follow(target, range));
  }

  /// Whether the motion has ended, exactly on the target.
  bool rests() const noexcept { return shaper_.at_target() && (!averages() || mean_.rests()); }
  double lag_s() const noexcept { return averages() ? mean_.lag_s() : 0.0; }
  /// The same of a path.
  double path_lag_s() const noexcept { return unasked_ != Mean::kNever ? mean_.lag_s() : 0.0; }
  /// Of the shaper's motion, which may be ahead: where the next sample begins, and where it ends.
  double position_rad() const noexcept { return shaper_.position_rad(); }
  double velocity_rad_s() const noexcept { return shaper_.velocity_rad_s(); }
  double target_rad() const noexcept { return shaper_.target_rad(); }

 private:
  enum class Mean { kNever, kAlways, kPaused, kEasing };

  ReferencePlan(double period_s, const JerkLimit& mean, Mean mean_is) noexcept
      : shaper_(period_s), mean_(mean), unasked_(mean_is), mean_is_(mean_is) {}
  bool averages() const noexcept { return mean_is_ == Mean::kAlways || mean_is_ == Mean::kEasing; }
  Reference averaged(const Reference& planned) noexcept { return averages() ? mean_.step(planned) : planned; }
  double ahead_of(double position_rad, double velocity_rad_s) noexcept {
    return averages() ? mean_.reset(position_rad, velocity_rad_s) : position_rad;
  }

  ReferenceShaper shaper_;
  JerkLimit mean_;
  Mean unasked_;  ///< as it begins
  Mean mean_is_;
};

}  // namespace strainwave
