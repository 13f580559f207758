// One joint in the loop: reads its drive, judges what it reads, obeys orders, runs the control law, commands the drive.
// step() is real-time safe. Everything around the mathematics lives here; the mathematics is control/joint_controller.h.
// Positions inside are the drive's; daemon/realtime/joint_zero.h stands at the border.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "control/joint/inertia_estimate.h"
#include "control/joint_controller.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/cycle_time.h"
#include "daemon/realtime/fault_reach.h"
#include "daemon/realtime/flight_recorder.h"
#include "daemon/realtime/friction_history.h"
#include "daemon/realtime/homing.h"
#include "daemon/realtime/joint_loop_config.h"
#include "daemon/realtime/joint_mode.h"
#include "daemon/realtime/joint_zero.h"
#include "daemon/realtime/motion_watch.h"
#include "daemon/realtime/ordered_target.h"
#include "daemon/realtime/orders.h"
#include "daemon/realtime/path_slots.h"
#include "daemon/realtime/reading_watch.h"
#include "daemon/realtime/speed_gauge.h"
#include "daemon/realtime/temperature_check.h"
#include "daemon/realtime/temperature_schedule.h"
#include "drivers/actuator.h"
#include "drivers/faulty_actuator.h"

namespace strainwave {

class PathFollower;

class JointLoop {
 public:
  /// Tables in turn: the active one, the one before, and one for the supervisor to write the next into.
  static constexpr std::size_t kTableSlots = 3;
  struct TableSlot {
    GainTable table;
    std::int64_t id = 0;                 ///< digest
    std::int64_t friction_rules_id = 0;  ///< digest of its friction rules
  };

  /// `actuator` is owned. The queues are the loop's, shared by all joints, and outlive it.
  JointLoop(std::int64_t index, const JointLoopConfig& config, std::unique_ptr<Actuator> actuator,
            ReplyQueue& replies, EventQueue& events);

  // Supervisor's thread.
  OrderQueue& orders() noexcept { return orders_; }
  /// The supervisor may write a slot only while no order names it and it is neither active nor previous.
  TableSlot& table_slot(std::size_t slot) noexcept { return tables_[slot]; }

  PathSlots& path_slots() noexcept { return path_slots_; }

  /// Before the loop runs: who is told of orders that are for all joints of a path. It outlives this object.
  void follow_paths_of(PathFollower& follower) noexcept { follower_ = &follower; }
  /// Before the loop runs: what an earlier run of the daemon learned, with the rules of the first table.
  void restore(const LearnedFriction& learned, const FrictionHistory& history) noexcept {
    controller_.set_learned(learned);
    friction_ = history;
  }
  /// Before the loop runs: where every cycle is recorded. It outlives this object.
  void record_into(FlightRecorder& recorder) noexcept { recorder_ = &recorder; }

  // Real-time thread.
  void step(const CycleTime& time) noexcept;
  /// Its own, or of something outside this joint (overruns, group); with the drive's number, or what the daemon found itself.
  void raise_fault(Fault fault, const CycleTime& time,
                   std::optional<std::uint32_t> own_finding = {}) noexcept;
  /// Zero torque and disable, at once; the last act of the loop.
  void stop_drive() noexcept { actuator_->stop(); }
  /// The loop ends: the joint comes to rest, and from now on every order that could set it moving is refused. May be repeated.
  void end(const CycleTime& time) noexcept;
  /// Whether the joint has faulted in this cycle in a way that stops its group.
  bool stops_group(const CycleTime& time) const noexcept {
    return config_.fault_stops_group && mode() == Mode::kFaulted && mode_.began(time.now_ns) &&
           mode_.fault() != Fault::kGroup;
  }
  /// How those must stop that stop with it. One that yields has run into something, like one that has a fault for it.
  OthersStop others_stop() const noexcept {
    return controller_.yields() ? OthersStop::kAtOnce
                                : strainwave::others_stop(mode_.fault(), mode_.drive_error());
  }
  // Of a path: for its follower.
  /// What it has of one, begun or not; null: nothing.
  const LoadedPath* path() const noexcept { return path_; }
  /// Whether it could begin `path` in this cycle: it holds where the path begins.
  Ruling may_begin(const LoadedPath& path) const noexcept;
  void begin_path(const CycleTime& time) noexcept;
  /// How much later than it is told the joint is where it is told to be on a path.
  double path_lead_s() const noexcept { return controller_.lead_s(); }
  /// The same of its setpoint, which a state shows as it was when the period began.
  double path_setpoint_lag_s() const noexcept { return controller_.lead_s(); }
  /// Where it is to be `in_periods` after the begin of this one.
  void follow_path(const PathPoint& point, std::int64_t in_periods) noexcept;
  void note_path(const OrderedTarget::PathProgress& progress) noexcept { ordered_.note(progress); }
  /// From begin_path() until end_path(), or until something else took the joint off it.
  bool on_path() const noexcept { return ordered_.on_path(); }
  /// It comes to rest along it: told until it is off it.
  void path_ends() noexcept { ordered_.path_ends(); }
  bool setpoint_rests() const noexcept { return motion_.at_target; }
  void end_path() noexcept;
  /// Comes to rest by itself, off the path.
  void stop_beside_path() noexcept;
  const MotionLimits& motion_limits() const noexcept { return config_.controller.motion; }

  int group() const noexcept { return config_.group; }
  bool at_rest() const noexcept { return mode() == Mode::kOff || mode() == Mode::kFaulted; }
  Mode mode() const noexcept { return mode_.mode(); }
  const StateRecord& record() const noexcept { return record_; }
  /// Of this period's position, from its sampling until it came; 0: not known, or none came.
  std::int64_t position_delay_ns() const noexcept { return watch_.fresh() ? reading().position_delay_ns : 0; }

 private:
  enum class Service { kServing, kEnding };
  /// The torque that held the joint when it last rested under control, and where that was; before, the configuration's.
  struct HeldLoad {
    double torque_Nm = 0.0;
    std::optional<double> position_rad;
  };
  // The steps of a period, in their order.
  void take_orders(const CycleTime& time) noexcept;
  void read_drive(const CycleTime& time) noexcept;
  void check_reading(const CycleTime& time) noexcept;
  void check_temperature(const CycleTime& time) noexcept;
  void expire_setpoint(const CycleTime& time) noexcept;
  void advance_homing(const CycleTime& time) noexcept;
  void control(const CycleTime& time) noexcept;
  void estimate_inertia(const JointMeasurement& measurement) noexcept;
  bool shows_other_inertia() const noexcept;
  void take_over(const CycleTime& time) noexcept;
  double load_here_Nm() const noexcept;
  void check_motion(const CycleTime& time) noexcept;
  void stop_overloaded(const CycleTime& time) noexcept;
  void advance_mode(const CycleTime& time) noexcept;
  void command_drive(const CycleTime& time) noexcept;
  void tell(const CycleTime& time) noexcept;

  Ruling obey(const Order& order, const CycleTime& time) noexcept;
  Ruling enable(const CycleTime& time) noexcept;
  Ruling use_table(const TableSlot& slot) noexcept;
  Ruling reset_learning() noexcept;
  void forget_learned() noexcept;
  Ruling begin_setpoint(const Order& order, const CycleTime& time) noexcept;
  Ruling judge_begin(const Order& order, double target_rad, double ahead_s) noexcept;
  SampleFate follow_stream(const Order& order, double target_rad, std::int64_t in_periods) noexcept;
  double move_speed_rad_s() const noexcept {
    return config_.move_speed_share * config_.controller.motion.velocity_rad_s;
  }
  Ruling stream_ended(std::int64_t stream_id) const noexcept;
  Ruling take_path(const Order& order) noexcept;
  void drop_path() noexcept;
  PositionRange reachable_range() const noexcept;
  Reason hold() noexcept;
  Reason clear_fault(const CycleTime& time) noexcept;
  Reason inject(const Injection& injection) noexcept;
  Reason home(const CycleTime& time) noexcept;

  Homing::Observation observe(const CycleTime& time) const noexcept;
  void obey_homing(const Homing::Order& order) noexcept;
  void end_homing(const CycleTime& time) noexcept;
  bool into_limit_switch(double direction) const noexcept;
  void refuse_torque_into_limit_switch() noexcept;
  void note_limits(const JointMeasurement& measurement) noexcept;
  bool change_mode(ModeEvent event, const CycleTime& time) noexcept;
  void raise_oscillation(const CycleTime& time) noexcept;
  void mode_changed(Mode from, const CycleTime& time) noexcept;
  void notice(Notice notice) noexcept { notices_ |= static_cast<std::int32_t>(notice); }
  const ActuatorReading& reading() const noexcept { return watch_.reading(); }
  /// As the control law has it, or the drive, or by the positions.
  double measured_velocity_rad_s() const noexcept {
    if (mode_.controlled()) return motion_.joint_velocity_rad_s;
    return reading().has_velocity ? reading().joint_velocity_rad_s : speed_gauge_.velocity_rad_s();
  }

  std::int64_t index_;
  JointLoopConfig config_;
  std::unique_ptr<Actuator> actuator_;
  FaultyActuator* injector_;  ///< the same object when it takes injected faults, else null
  ReplyQueue& replies_;
  EventQueue& events_;
  OrderQueue orders_;
  std::array<TableSlot, kTableSlots> tables_{};
  const TableSlot* table_ = nullptr;  ///< the active one
  PathSlots path_slots_;
  const LoadedPath* path_ = nullptr;  ///< begun or not
  PathFollower* follower_ = nullptr;
  FlightRecorder* recorder_ = nullptr;

  JointMode mode_;
  ReadingWatch watch_;
  TemperatureCheck temperature_;
  TemperatureSchedule schedule_;
  OrderedTarget ordered_;
  JointZero zero_;
  Homing homing_;
  JointController controller_;
  InertiaEstimate inertia_;
  MotionWatch motion_watch_;
  SpeedGauge speed_gauge_;  ///< while nothing is controlled
  FrictionHistory friction_;
  HeldLoad held_;
  std::optional<Yield> yield_;       ///< since the last order that moved the joint, or cleared a fault
  std::int64_t yielded_stream_ = 0;  ///< which it ended; 0: none
  bool approaches_ = false;          ///< the stream began far from the joint, which is not on it yet
  std::int64_t late_samples_ = 0;    ///< of streams, since the start
  Service service_ = Service::kServing;
  std::int64_t faulted_cycle_ = -1;  ///< the last in which it faulted
  JointStep motion_;                 ///< of this period
  std::int32_t notices_ = 0;         ///< of this period
  StateRecord record_{};
};

}  // namespace strainwave
