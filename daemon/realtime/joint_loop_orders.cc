// What a joint makes of orders: JointLoop's methods that obey them. Real-time safe.
#include <algorithm>
#include <cmath>

#include "daemon/realtime/joint_loop.h"

namespace strainwave {

namespace {

constexpr double kNanosecondsPerSecond = 1e9;

double largest_static_friction_Nm(const FuzzyFriction& friction) noexcept {
  double largest_Nm = 0.0;
  for (std::int32_t i = 0; i < friction.rule_count; ++i)
    largest_Nm = std::max(largest_Nm, friction.rules[static_cast<std::size_t>(i)].friction.static_Nm);
  return largest_Nm;
}

}  // namespace

void JointLoop::take_orders(const CycleTime& time) noexcept {
  Order order;
  while (orders_.pop(order)) {
    const Reason reason = obey(order, time);
    // A full reply queue loses the answer, not the order; the client sees a time-out and asks the state.
    if (order.id != 0) (void)replies_.push({order.id, reason, mode_});
  }
}

Reason JointLoop::obey(const Order& order, const CycleTime& time) noexcept {
  switch (order.kind) {
    case OrderKind::kEnable:
      return enable(time);
    case OrderKind::kDisable:
      return change_mode(ModeEvent::kDisableOrdered, time) ? Reason::kAccepted : Reason::kWrongMode;
    case OrderKind::kHold:
      return hold();
    case OrderKind::kClearFault:
      return clear_fault(time);
    case OrderKind::kSetpoint:
      return begin_setpoint(order, time);
    case OrderKind::kUseTable:
      return use_table(static_cast<std::size_t>(order.table_slot));
    case OrderKind::kInject:
      return inject(order.injection);
    case OrderKind::kHome:
      return home(time);
  }
  return Reason::kUnknownAction;
}

Reason JointLoop::enable(const CycleTime& time) noexcept {
  if (mode_ == Mode::kFaulted) return Reason::kFaulted;
  if (!controller_.has_table()) return Reason::kNoTable;
  // A drive that is silent because of a fault says so: the joint then faults, and the fault can be cleared.
  if (mode_ == Mode::kOff && !reading_fresh_ && reading_.fault == ActuatorFault::kNone)
    return Reason::kDriveNotReady;
  if (!change_mode(ModeEvent::kEnableOrdered, time)) return Reason::kWrongMode;
  setpoint_expired_ = false;
  stream_refused_ = false;
  return Reason::kAccepted;
}

Reason JointLoop::use_table(std::size_t slot) noexcept {
  // At rest a swap is always allowed; under control only while the reference stands still.
  const bool at_standstill = mode_ == Mode::kHolding;
  if (!at_rest() && !at_standstill) return Reason::kMoving;
  const GainTable& table = tables_[slot].table;
  controller_.load(table);
  table_id_ = tables_[slot].id;
  temperature_rules_ = table.friction.rule_count;
  table_min_C_ = table.friction.temperature_min_C;
  table_max_C_ = table.friction.temperature_max_C;
  position_check_.set_joint(table.plant.inertia_kgm2, largest_static_friction_Nm(table.friction));
  return Reason::kAccepted;
}

Reason JointLoop::begin_setpoint(const Order& order, const CycleTime& time) noexcept {
  if (mode_ == Mode::kFaulted) return Reason::kFaulted;
  const bool streamed = order.valid_for_s > 0.0;
  // A late packet of a stream that has ended must not set the joint moving again.
  if (streamed && stream_refused_) return Reason::kStreamExpired;
  if (!position_known()) return Reason::kNotHomed;
  const double target_rad = order.position_rad - position_offset_rad_;
  if (into_limit_switch(target_rad - reading_.joint_position_rad)) return Reason::kAtLimitSwitch;
  if (!change_mode(ModeEvent::kSetpointAccepted, time)) return Reason::kWrongMode;
  controller_.set_target(target_rad, order.speed_limit_rad_s);
  ordered_target_rad_ = target_rad;
  ordered_position_rad_ = order.position_rad;
  setpoint_expires_ns_ =
      streamed ? time.now_ns + static_cast<std::int64_t>(order.valid_for_s * kNanosecondsPerSecond) : 0;
  setpoint_expired_ = false;
  stream_refused_ = false;
  return Reason::kAccepted;
}

Reason JointLoop::hold() noexcept {
  if (!is_controlled(mode_)) return Reason::kWrongMode;
  controller_.stop();
  homing_.abort();
  setpoint_expires_ns_ = 0;
  stream_refused_ = false;
  return Reason::kAccepted;
}

Reason JointLoop::inject(const Injection& injection) noexcept {
  if (injector_ == nullptr) return Reason::kNotSimulated;
  injector_->inject(injection);
  return Reason::kAccepted;
}

Reason JointLoop::clear_fault(const CycleTime& time) noexcept {
  if (mode_ != Mode::kFaulted) return Reason::kWrongMode;
  actuator_->clear_fault();
  missed_readings_ = 0;
  return change_mode(ModeEvent::kFaultCleared, time) ? Reason::kAccepted : Reason::kWrongMode;
}

}  // namespace strainwave
