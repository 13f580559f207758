// SPDX-License-Identifier: BSD-3-Clause
// The time along a path. It runs with the clock, or slower while the path pauses or resumes, so that the joints stay on the path.
// Real-time safe; time is counted in seconds of the path.
//
// With the rate r of the path's time s, a joint moves with
//
//   v = v(s) r
//   a = a(s) r^2 + v(s) r'
//
// so that its acceleration limit bounds r'. While the path keeps the limits, r' = 0 keeps them for every r up to 1: the rate can always
// stay constant. A joint that uses all of its deceleration comes to rest without a change of the rate.
#pragma once

#include <array>
#include <cstddef>

#include "control/trajectory/knot_path.h"

namespace strainwave {

/// How fast the rate may fall and rise, 1/s, both >= 0.
struct RateRoom {
  double falling_1_s = 0.0;
  double rising_1_s = 0.0;

  /// The room that two joints on one path leave together.
  RateRoom both(const RateRoom& other) const noexcept;
};

/// Room that a joint with these limits leaves. It is at `here` now and at `next` at the end of the period, with time at `rate`.
RateRoom rate_room(const Reference& here, const Reference& next, double rate,
                   const MotionLimits& limits) noexcept;

/// A time of the path, and its rate; by default those of a path that has not begun.
struct PathTime {
  double time_s = 0.0;
  double rate = 0.0;
  double rate_change_1_s = 0.0;  ///< over the last period
};

/// Begins at 0 and at the full rate, since a path begins at rest.
class PathClock {
 public:
  /// Largest room: between standstill and full rate the time takes at least 0.1 s. Slow paths would allow larger changes of the rate, but
  /// those would be a jerk.
  static constexpr RateRoom kMostRoom{10.0, 10.0};

  void run() noexcept { wish_ = Wish::kRun; }
  void rest() noexcept { wish_ = Wish::kRest; }
  /// Advances by one period.
  void advance(double period_s, const RateRoom& room) noexcept;

  double time_s() const noexcept { return time_s_; }
  double rate() const noexcept { return rate_; }
  PathTime now() const noexcept { return {time_s_, rate_, change_1_s_}; }
  /// Whether the rate stays constant in the next period, for any room.
  bool steady() const noexcept { return rate_ == wanted(); }
  /// Whether the path rests or is coming to rest.
  bool is_to_rest() const noexcept { return wish_ == Wish::kRest; }

 private:
  enum class Wish { kRun, kRest };
  double wanted() const noexcept { return wish_ == Wish::kRun ? 1.0 : 0.0; }

  Wish wish_ = Wish::kRun;
  double time_s_ = 0.0;
  double rate_ = 1.0;
  double change_1_s_ = 0.0;
};

/// A path's time in each of the last periods.
class PathTimes {
 public:
  static constexpr std::size_t kPeriods = 256;

  /// Records `now`, one period after the last record.
  void note(const PathTime& now) noexcept;
  /// The time `periods` before the last record, in [0, kPeriods - 2]; linear between records. Before them the path has not begun.
  PathTime ago(double periods) const noexcept;

 private:
  std::array<PathTime, kPeriods> times_{};
  std::size_t last_ = 0;
};

/// Motion of the joint at `point` of its path, with the rate of `time` and its change.
Reference in_path_time(const Reference& point, const PathTime& time) noexcept;

}  // namespace strainwave
