// SPDX-License-Identifier: BSD-3-Clause
// The time along a path: it runs with the clock, or slower while the path is paused or resumed, so that the joints stay on the path.
// Real-time safe; time is counted in seconds of the path.
//
// With the rate r of the path's time s, what a joint does is
//
//   v = v(s) r
//   a = a(s) r^2 + v(s) r'
//
// so that a limit of the joint's acceleration bounds r'. While the path keeps the limits, r' = 0 does for every r up to 1: the rate can always
// stay, and a joint that is just using all of its deceleration is on its way to rest by itself.
#pragma once

#include <array>
#include <cstddef>

#include "control/trajectory/knot_path.h"

namespace strainwave {

/// How fast the rate may fall and rise, 1/s, both >= 0.
struct RateRoom {
  double falling_1_s = 0.0;
  double rising_1_s = 0.0;

  /// Of two joints on one path.
  RateRoom both(const RateRoom& other) const noexcept;
};

/// What a joint with these limits leaves that is at `here` now and at `next` at the end of the period, while the time goes at `rate`.
RateRoom rate_room(const Reference& here, const Reference& next, double rate,
                   const MotionLimits& limits) noexcept;

/// Where a path's time is, and how it goes; by default a path that has not begun.
struct PathTime {
  double time_s = 0.0;
  double rate = 0.0;
  double rate_change_1_s = 0.0;  ///< over the last period
};

/// Begins at 0, at the full rate: a path begins at rest.
class PathClock {
 public:
  /// None allows more than this one: from rest to the full rate and back takes at least 0.1 s. What the accelerations allow of slow paths
  /// would be a jerk.
  static constexpr RateRoom kMostRoom{10.0, 10.0};

  void run() noexcept { wish_ = Wish::kRun; }
  void rest() noexcept { wish_ = Wish::kRest; }
  /// One period later.
  void advance(double period_s, const RateRoom& room) noexcept;

  double time_s() const noexcept { return time_s_; }
  double rate() const noexcept { return rate_; }
  PathTime now() const noexcept { return {time_s_, rate_, change_1_s_}; }
  /// Whether the rate stays in the next period, whatever the room.
  bool steady() const noexcept { return rate_ == wanted(); }
  /// Whether it rests or is to come to rest.
  bool is_to_rest() const noexcept { return wish_ == Wish::kRest; }

 private:
  enum class Wish { kRun, kRest };
  double wanted() const noexcept { return wish_ == Wish::kRun ? 1.0 : 0.0; }

  Wish wish_ = Wish::kRun;
  double time_s_ = 0.0;
  double rate_ = 1.0;
  double change_1_s_ = 0.0;
};

/// A path's time in the last periods.
class PathTimes {
 public:
  static constexpr std::size_t kPeriods = 256;

  /// One period later it is `now`.
  void note(const PathTime& now) noexcept;
  /// `periods` before the last one, in [0, kPeriods - 2]; between two periods the mean of both. Before all of them the path has not begun.
  PathTime ago(double periods) const noexcept;

 private:
  std::array<PathTime, kPeriods> times_{};
  std::size_t last_ = 0;
};

/// What the joint does at `point` of its path while the time goes as `time` says.
Reference in_path_time(const Reference& point, const PathTime& time) noexcept;

}  // namespace strainwave
