// Keeps the jerk of a planned motion within a limit, whatever is planned: the mean of the motion over the last periods. Real-time safe.
//
// Of a motion whose acceleration stays within A in both directions, the mean over w has
//   |jerk| <= 2 A / w
// and keeps speed, acceleration, position range and a target that is reached exactly, because all of them are means. It is later by w / 2
// (control/moving_mean.h). A link on a spring has such a mean in its motion already (control/link_motion.h), w = tau / 2:
//   |jerk| <= sqrt(2) A w0,   w0 the free swing's angular frequency
#pragma once

#include "control/moving_mean.h"
#include "control/reference_shaper.h"

namespace strainwave {

class JerkLimit {
 public:
  /// The limits under which kMaxMeanPeriods suffice to keep `jerk_rad_s3` > 0: accelerations of at most jerk * width / 2.
  static MotionLimits possible(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept;

  /// For motions within `limits`, which must be possible().
  JerkLimit(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept;
  /// The mean over `width_s` > 0, over at most kMaxMeanPeriods.
  static JerkLimit spread_over(double width_s, double period_s) noexcept;

  /// The motion is there now, at constant velocity. Where the planned motion, which is ahead, must go on from.
  double reset(double position_rad, double velocity_rad_s) noexcept;
  /// Where the next sample begins.
  double position_rad() const noexcept { return now_.position_rad; }
  double velocity_rad_s() const noexcept { return now_.velocity_rad_s; }
  /// The planned motion's next sample, its acceleration that of the period that follows; likewise what comes of it.
  Reference step(const Reference& planned) noexcept;

  /// Whether nothing is left to be done once the planned motion rests.
  bool rests() const noexcept { return rest_periods_ >= periods_; }
  double lag_s() const noexcept { return mean_.lag_s(); }

 private:
  JerkLimit(int periods, double period_s) noexcept;

  int periods_;
  double period_s_;
  MovingMean mean_;
  MotionPoint now_;
  int rest_periods_ = 0;  ///< of the planned motion
};

}  // namespace strainwave
