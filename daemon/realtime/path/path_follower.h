// SPDX-License-Identifier: BSD-3-Clause
// Moves joints along paths: tracks which joints belong together, and computes the setpoint of each. The joints of a path share
// one clock (control/trajectory/path_clock.h): they start, pause, resume and arrive in the same cycle, and stay on the path in
// between. A joint lags its plan by its delay, jerk limit or spring. The joint with the largest lag gets the clock's time, the
// others an earlier time. So the joints are synchronised, although their setpoints are not. Real-time safe.
//
//   resume   -> all joints of the path begin in the next cycle, or none
//   pause    -> the path's time comes to rest, as quickly as the accelerations allow
//   one joint is lost (hold, disable, fault, yield, another order)
//            -> each of the others stops on its own in the next cycle, and the path is over
//
// The joints also stop after a gap of more than kMaxElapsedPeriods in which the loop did not run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "control/trajectory/path_clock.h"
#include "daemon/realtime/joint/orders.h"
#include "daemon/realtime/loop/cycle_time.h"

namespace strainwave {

class JointLoop;

class PathFollower {
 public:
  /// `joints` outlive this object and refer to it.
  PathFollower(std::span<const std::unique_ptr<JointLoop>> joints, double period_s);
  PathFollower(const PathFollower&) = delete;
  PathFollower& operator=(const PathFollower&) = delete;

  /// Starts the path that `joint` is part of, with all its joints, or resumes it.
  Ruling resume(std::size_t joint) noexcept;
  Ruling pause(std::size_t joint) noexcept;

  /// Gives each joint on a path its setpoint. Call it before the joints' own steps.
  void advance(const CycleTime& time) noexcept;

 private:
  enum class Phase { kFree, kBeginning, kUnderWay };
  /// One path in progress.
  struct Travel {
    Phase phase = Phase::kFree;
    PathClock clock;
    PathTimes times;                   ///< recent times of the clock
    double most_behind_periods = 0.0;  ///< largest of its members
    double duration_s = 0.0;
  };
  /// A joint's part in a travel.
  struct Member {
    std::optional<std::size_t> travel;  ///< none: the joint is on no path
    PathReader reader;
    double behind_periods = 0.0;  ///< lag of the slowest joint minus that of this one
  };
  template <typename Act>
  void for_each_member(std::size_t travel, const Act& act) noexcept;
  Ruling begin(std::size_t joint) noexcept;
  bool begin_all(std::size_t travel, const CycleTime& time) noexcept;
  void wait_for_the_slowest(std::size_t travel) noexcept;
  void advance(std::size_t travel, const CycleTime& time) noexcept;
  bool has_lost_one(std::size_t travel) noexcept;
  void stop_each(std::size_t travel) noexcept;
  RateRoom room(std::size_t travel) noexcept;
  void free(std::size_t travel) noexcept;

  std::span<const std::unique_ptr<JointLoop>> joints_;
  double period_s_;
  std::vector<Member> members_;  ///< by joint
  std::vector<Travel> travels_;  ///< by the joint that got the order to begin
};

}  // namespace strainwave
