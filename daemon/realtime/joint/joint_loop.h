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
  /// Slots for the active table, the previous one, and the next one, which the supervisor writes.
  static constexpr std::size_t kTableSlots = 3;

  /// Not real-time safe. `actuator` is owned. The queues belong to the loop, are shared by all joints, and outlive this object.
  JointLoop(std::int64_t index, const JointLoopConfig& config, std::unique_ptr<Actuator> actuator,
            ReplyQueue& replies, EventQueue& events);

  // Supervisor's thread.
  JointOrderQueue& orders() noexcept { return orders_; }
  /// The supervisor may write a slot only while no order names it and it is neither active nor previous.
  TableSlot& table_slot(std::size_t slot) noexcept { return tables_[slot]; }

  /// Call it before the loop runs: `recorder`, which outlives this object, records every cycle.
  void record_into(FlightRecorder& recorder) noexcept { recorder_ = &recorder; }

  // Real-time thread.
  void step(const CycleTime& time) noexcept;
  /// The loop ends: the joint comes to rest, and refuses every order that could move it from now on. May be repeated.
  void end(const CycleTime& time) noexcept;
  /// For paths and groups. The supervisor may use law.restore() before the loop runs, and its side of path_slots.
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
  JointOrderQueue orders_;
  std::array<TableSlot, kTableSlots> tables_{};
  FlightRecorder* recorder_ = nullptr;
  StateRecord record_{};
  double driving_share_ = 1.0;
};

/// Call it after the step of every joint. If a joint faulted in this cycle, the others of its group fault, too (kGroup), and their
/// drives are stopped. Joints that are off stay off. Real-time safe.
void stop_groups_of_the_faulted(std::span<const std::unique_ptr<JointLoop>> joints,
                                const CycleTime& time) noexcept;
/// Raises a fault of the loop itself in every joint that is not off. Real-time safe.
void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept;

}  // namespace strainwave
