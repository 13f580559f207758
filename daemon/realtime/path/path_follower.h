// SPDX-License-Identifier: BSD-3-Clause
// Joints on paths: which belong together, and where each is to be in a period. The joints of a path have one clock
// (control/trajectory/path_clock.h): they leave, pause, go on and arrive in the same cycle, and are on the path in between.
// A joint may follow its plan later than another, by its delay, its jerk limit or its spring. The slowest gets the clock's own time, each other
// an earlier one: the joints are together, their setpoints are not. Real-time safe.
//
//   resume   -> all joints of the path begin in the next cycle, or none
//   pause    -> the path's time comes to rest, as quickly as the accelerations allow
//   one joint is lost (hold, disable, fault, yield, another order)
//            -> each of the others stops on its own in the next cycle, and the path is over
//
// So it is after a gap of more than kMaxElapsedPeriods in which the loop did not run.
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

  /// Starts the path that `joint` has a part of, with all of its joints, or goes on with it.
  Ruling resume(std::size_t joint) noexcept;
  Ruling pause(std::size_t joint) noexcept;

  /// Before the joints' own steps: gives each one on a path its setpoint.
  void advance(const CycleTime& time) noexcept;

 private:
  enum class Phase { kFree, kBeginning, kUnderWay };
  /// One path that is travelled.
  struct Travel {
    Phase phase = Phase::kFree;
    PathClock clock;
    PathTimes times;                   ///< of the clock
    double most_behind_periods = 0.0;  ///< of its members
    double duration_s = 0.0;
  };
  /// A joint's place on it.
  struct Member {
    std::optional<std::size_t> travel;  ///< nothing: it is on none
    PathReader reader;
    double behind_periods = 0.0;  ///< the clock: what the slowest joint is later than this one
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
  std::vector<Travel> travels_;  ///< by the joint that was ordered to begin
};

}  // namespace strainwave
