// SPDX-License-Identifier: BSD-3-Clause
// One joint in the loop: the steps of its period, in their order. step() is real-time safe. The parts that act are in
// daemon/realtime/joint/joint_in_loop.h, the mathematics in control/joint_controller.h.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/joint/joint_in_loop.h"
#include "daemon/realtime/loop/flight_recorder.h"

namespace strainwave {

class JointLoop {
 public:
  /// Tables in turn: the active one, the one before, and one for the supervisor to write the next into.
  static constexpr std::size_t kTableSlots = 3;

  /// Not real-time safe. `actuator` is owned. The queues are the loop's, shared by all joints, and outlive it.
  JointLoop(std::int64_t index, const JointLoopConfig& config, std::unique_ptr<Actuator> actuator,
            ReplyQueue& replies, EventQueue& events);

  // Supervisor's thread.
  OrderQueue& orders() noexcept { return orders_; }
  /// The supervisor may write a slot only while no order names it and it is neither active nor previous.
  TableSlot& table_slot(std::size_t slot) noexcept { return tables_[slot]; }

  /// Before the loop runs: where every cycle is recorded. It outlives this object.
  void record_into(FlightRecorder& recorder) noexcept { recorder_ = &recorder; }

  // Real-time thread.
  void step(const CycleTime& time) noexcept;
  /// The loop ends: the joint comes to rest, and from now on every order that could set it moving is refused. May be repeated.
  void end(const CycleTime& time) noexcept;
  /// For paths, and for groups. Of the supervisor's: law.restore() before the loop runs, and its side of path_slots.
  JointInLoop& joint() noexcept { return joint_; }
  const JointInLoop& joint() const noexcept { return joint_; }
  Mode mode() const noexcept { return joint_.mode.mode(); }
  const StateRecord& record() const noexcept { return record_; }

 private:
  // The steps of a period, in their order.
  void take_orders(const CycleTime& time) noexcept;
  void read_drive(const CycleTime& time) noexcept;
  void check_reading(const CycleTime& time) noexcept;
  void check_temperature(const CycleTime& time) noexcept;
  void expire_setpoint(const CycleTime& time) noexcept;
  void control(const CycleTime& time) noexcept;
  void advance_mode(const CycleTime& time) noexcept;
  void take_over(const CycleTime& time) noexcept;
  void command_drive(const CycleTime& time) noexcept;
  void note_standing() noexcept;
  void publish(const CycleTime& time) noexcept;

  JointInLoop joint_;
  ReplyQueue& replies_;
  OrderQueue orders_;
  std::array<TableSlot, kTableSlots> tables_{};
  FlightRecorder* recorder_ = nullptr;
  StateRecord record_{};
  double driving_share_ = 1.0;
};

/// After every joint has made its step. Where a joint has faulted in this cycle, the others of its group fault (kGroup) and their drives are
/// stopped. Joints that are off stay off. Real-time safe.
void stop_groups_of_the_faulted(std::span<const std::unique_ptr<JointLoop>> joints,
                                const CycleTime& time) noexcept;
/// A fault of the loop itself, for every joint that is not off. Real-time safe.
void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept;

}  // namespace strainwave
