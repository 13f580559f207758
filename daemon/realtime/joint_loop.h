// One joint in the loop: reads its drive, judges what it reads, obeys orders, runs the control law, commands the drive.
// step() is real-time safe. Everything around the mathematics lives here; the mathematics is control/joint_controller.h.
//
// Controller and homing count positions as the drive does; what comes from outside and goes there is moved by the offset that
// homing finds. So a joint that becomes homed does not jump, and nothing in the control law begins anew.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "control/joint_controller.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/flight_recorder.h"
#include "daemon/realtime/homing.h"
#include "daemon/realtime/mode_machine.h"
#include "daemon/realtime/orders.h"
#include "daemon/realtime/position_check.h"
#include "daemon/realtime/temperature_check.h"
#include "drivers/actuator.h"
#include "drivers/faulty_actuator.h"

namespace strainwave {

/// Limits of one joint, joint side. Exceeding one latches a fault; the reference never leaves the softer ones.
struct JointLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double position_margin_rad = 0.0;  ///< fault beyond position_min - margin and position_max + margin
  double overspeed_rad_s = 0.0;      ///< fault
  double following_error_rad = 0.0;  ///< fault: |reference - position|
  double hot_C = 0.0;                ///< fault above
};

struct JointLoopConfig {
  JointControllerConfig controller;
  JointLimits limits;
  TemperatureCheckConfig temperature;
  HomingConfig homing;
  double temperature_update_period_s = 0.01;  ///< how often the gains are scheduled anew
  int group = -1;                             ///< joints with the same number >= 0 belong together
  bool fault_stops_group = false;             ///< a fault of this joint stops the others of its group
  double start_timeout_s = 2.0;               ///< from enable to the drive's readiness
  double stop_timeout_s = 3.0;                ///< from disable to standstill
  double standstill_rad_s = 0.01;
  int missed_readings_limit = 5;  ///< periods without a fresh position before it is a fault
};

/// When this cycle happens.
struct CycleTime {
  std::int64_t now_ns = 0;
  std::int64_t cycle = 0;
};

class JointLoop {
 public:
  /// Tables in turn: the active one, the one before, and one for the supervisor to write the next into.
  static constexpr std::size_t kTableSlots = 3;
  struct TableSlot {
    GainTable table;
    std::int64_t id = 0;  ///< digest
  };

  /// `actuator` is owned. The queues are the loop's, shared by all joints, and outlive it.
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
  /// The fault of something outside this joint (overruns, group).
  void raise_fault(Fault fault, const CycleTime& time) noexcept;
  /// Zero torque and disable, at once; the last act of the loop.
  void stop_drive() noexcept { actuator_->stop(); }
  void order_disable(const CycleTime& time) noexcept { (void)change_mode(ModeEvent::kDisableOrdered, time); }
  /// Whether the joint has faulted since the last call in a way that stops its group.
  bool take_group_stop() noexcept { return std::exchange(group_stop_due_, false); }
  int group() const noexcept { return config_.group; }
  bool at_rest() const noexcept { return mode_ == Mode::kOff || mode_ == Mode::kFaulted; }
  Mode mode() const noexcept { return mode_; }
  const StateRecord& record() const noexcept { return record_; }

 private:
  void take_orders(const CycleTime& time) noexcept;
  Reason obey(const Order& order, const CycleTime& time) noexcept;
  Reason enable(const CycleTime& time) noexcept;
  Reason use_table(std::size_t slot) noexcept;
  Reason begin_setpoint(const Order& order, const CycleTime& time) noexcept;
  Reason hold() noexcept;
  Reason clear_fault(const CycleTime& time) noexcept;
  Reason inject(const Injection& injection) noexcept;
  Reason home(const CycleTime& time) noexcept;
  void read_drive(const CycleTime& time) noexcept;
  void check_reading(const CycleTime& time) noexcept;
  void check_temperature(const CycleTime& time) noexcept;
  void expire_setpoint(const CycleTime& time) noexcept;
  double scheduling_temperature_C(const CycleTime& time) noexcept;
  void control(const CycleTime& time) noexcept;
  Homing::Observation observe(const CycleTime& time) const noexcept;
  void obey_homing(const Homing::Order& order) noexcept;
  void advance_homing(const CycleTime& time) noexcept;
  void end_homing(const CycleTime& time) noexcept;
  bool into_limit_switch(double direction) const noexcept;
  void refuse_torque_into_limit_switch() noexcept;
  /// Whether positions mean what the configuration says.
  bool position_known() const noexcept { return homed_ || !config_.homing.required; }
  void check_motion(const CycleTime& time) noexcept;
  void advance_mode(const CycleTime& time) noexcept;
  void command_drive(const CycleTime& time) noexcept;
  void fill_record(const CycleTime& time) noexcept;
  void record_flight(const CycleTime& time) noexcept;
  bool change_mode(ModeEvent event, const CycleTime& time, Fault fault = Fault::kNone) noexcept;
  void notice(Notice notice) noexcept { notices_ |= static_cast<std::int32_t>(notice); }
  double seconds_in_mode(const CycleTime& time) const noexcept {
    return static_cast<double>(time.now_ns - mode_since_ns_) * 1e-9;
  }

  std::int64_t index_;
  JointLoopConfig config_;
  std::unique_ptr<Actuator> actuator_;
  FaultyActuator* injector_;  ///< the same object when it takes injected faults, else null
  ReplyQueue& replies_;
  EventQueue& events_;
  OrderQueue orders_;
  std::array<TableSlot, kTableSlots> tables_{};

  JointController controller_;
  Homing homing_;
  TemperatureCheck temperature_;
  PositionCheck position_check_;
  FlightRecorder* recorder_ = nullptr;
  ActuatorReading reading_;
  JointStep motion_;
  StateRecord record_{};
  Mode mode_ = Mode::kOff;
  Fault fault_ = Fault::kNone;
  std::int64_t mode_since_ns_ = 0;
  std::int64_t faults_total_ = 0;
  std::uint32_t drive_error_ = 0;         ///< at the last fault
  std::int64_t setpoint_expires_ns_ = 0;  ///< 0: a move, which does not expire
  std::int64_t table_id_ = 0;
  std::int64_t temperature_update_periods_;
  std::int64_t next_temperature_cycle_ = 0;
  double ordered_target_rad_ = 0.0;    ///< of the last setpoint, as the drive counts
  double ordered_position_rad_ = 0.0;  ///< the same as it was ordered
  double position_offset_rad_ = 0.0;   ///< what the drive counts plus this is the joint's position
  double scheduling_temperature_C_ = 0.0;
  double table_min_C_ = 0.0;
  double table_max_C_ = 0.0;
  std::int32_t temperature_rules_ = 0;
  std::int32_t notices_ = 0;
  int missed_readings_ = 0;
  bool reading_fresh_ = false;
  bool ever_read_ = false;
  bool homed_ = false;
  bool setpoint_expired_ = false;  ///< shown until the next setpoint is accepted
  bool stream_refused_ = false;    ///< a stream has expired and nobody has said that a new one begins
  bool group_stop_due_ = false;
  bool drive_stopped_ = false;  ///< stop() has been called since the fault
};

}  // namespace strainwave
