// SPDX-License-Identifier: BSD-3-Clause
// One joint in the loop: its parts, and its changes of mode, which affect all parts. JointLoop (daemon/realtime/joint/joint_loop.h)
// runs them in order; each function below covers one subject. Real-time safe. Positions are as the drive counts them; `zero`
// converts them to joint positions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "daemon/realtime/joint/homing.h"
#include "daemon/realtime/joint/joint_drive.h"
#include "daemon/realtime/joint/joint_law.h"
#include "daemon/realtime/joint/joint_loop_config.h"
#include "daemon/realtime/joint/joint_mode.h"
#include "daemon/realtime/joint/joint_zero.h"
#include "daemon/realtime/joint/motion_watch.h"
#include "daemon/realtime/joint/ordered_target.h"
#include "daemon/realtime/joint/orders.h"
#include "daemon/realtime/loop/cycle_time.h"
#include "daemon/realtime/path/path_slots.h"

namespace strainwave {

class PathFollower;

struct JointInLoop {
  struct StreamNotes {
    bool approaches = false;        ///< the stream began far from the joint, which has not reached it yet
    std::int64_t late_samples = 0;  ///< of all streams since the start
    std::int64_t yielded_id = 0;    ///< the stream that a yield ended; 0: none
  };

  /// Not real-time safe. `actuator` is owned; the queue outlives this object.
  JointInLoop(std::int64_t joint, const JointLoopConfig& joint_config, std::unique_ptr<Actuator> actuator,
              EventQueue& event_queue);

  bool change_mode(ModeEvent event, const CycleTime& time) noexcept;
  /// Latches `fault` with the drive's error number, or with the daemon's `own_finding`. The first fault stays.
  void raise_fault(Fault fault, const CycleTime& time,
                   std::optional<std::uint32_t> own_finding = {}) noexcept;
  void notice(Notice notice) noexcept { notices |= static_cast<std::int32_t>(notice); }
  void drop_path() noexcept;
  /// Ends the stream or path.
  void end_orders() noexcept;
  /// From the control law; without control from the drive, or from positions.
  double velocity_rad_s() const noexcept {
    return mode.controlled() ? law.motion().joint_velocity_rad_s : drive.velocity_rad_s();
  }
  /// The position limits, as the drive counts positions.
  PositionRange reachable_range() const noexcept {
    return {zero.to_drive_rad(config.limits.position_min_rad),
            zero.to_drive_rad(config.limits.position_max_rad)};
  }
  /// Whether the joint has faulted in this cycle in a way that stops its group.
  bool stops_group(const CycleTime& time) const noexcept;
  bool at_rest() const noexcept { return mode.is(Mode::kOff) || mode.is(Mode::kFaulted); }

  std::int64_t index;
  JointLoopConfig config;
  EventQueue& events;
  JointDrive drive;
  JointMode mode;
  JointLaw law;
  OrderedTarget ordered;
  JointZero zero;
  Homing homing;
  MotionWatch motion_watch;
  PathSlots path_slots;
  const LoadedPath* path = nullptr;  ///< the joint's part of a path, begun or not; null: none
  PathFollower* follower = nullptr;  ///< shared by all joints; set before the loop runs, outlives this object
  std::optional<Yield> yield;        ///< set by a yield, until an order moves the joint or clears a fault
  StreamNotes stream;
  bool ending = false;              ///< the loop is ending: orders that move the joint are refused
  std::int64_t faulted_cycle = -1;  ///< the last cycle in which it faulted
  std::int32_t notices = 0;         ///< of this period

 private:
  void mode_changed(Mode from, const CycleTime& time) noexcept;
};

/// Obeys an order or refuses it. `tables`: the slots that kUseTable names.
Ruling obey(JointInLoop& joint, const Order& order, const CycleTime& time,
            std::span<const TableSlot> tables) noexcept;
/// Whether the joint could begin `path` in this cycle: it holds where the path begins.
Ruling may_begin_path(const JointInLoop& joint, const LoadedPath& path) noexcept;

Reason begin_homing(JointInLoop& joint, const CycleTime& time) noexcept;
/// One period of homing, before the control law.
void advance_homing(JointInLoop& joint, const CycleTime& time) noexcept;
/// After the control law: once home is found or a hold was ordered, the joint holds as soon as it rests.
void end_homing(JointInLoop& joint, const CycleTime& time) noexcept;

/// After the control law: notices of the limits that it reached.
void note_limits(JointInLoop& joint) noexcept;
/// Checks a joint under control for faults, and for a load to which it must yield.
void check_motion(JointInLoop& joint, const CycleTime& time) noexcept;

}  // namespace strainwave
