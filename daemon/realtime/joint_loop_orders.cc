// What a joint makes of orders: JointLoop's methods that obey them. Real-time safe.
#include <algorithm>
#include <cmath>
#include <optional>

#include "daemon/realtime/joint_loop.h"
#include "daemon/realtime/path_follower.h"

namespace strainwave {

namespace {

constexpr double kFarthestAhead_s = 1.0;  // of a setpoint that says when it is for

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
    // The loop may have stood still while the order waited, or the joint may have faulted.
    const bool waited_long = order.expires_cycle >= 0 && time.cycle > order.expires_cycle;
    const bool from_before_fault = order.challenge_cycle >= 0 && order.challenge_cycle <= faulted_cycle_;
    const bool too_old = waited_long || from_before_fault;
    const Ruling ruling = too_old ? Ruling(Reason::kTooOld) : obey(order, time);
    if (order.kind == OrderKind::kLoadPath) path_slots_.judged();
    // A full reply queue loses the answer, not the order; the client sees a time-out and asks the state.
    if (order.id != 0) (void)replies_.push({order.id, ruling.reason, mode(), ruling.value, ruling.limit});
  }
}

Ruling JointLoop::obey(const Order& order, const CycleTime& time) noexcept {
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
      return use_table(tables_[static_cast<std::size_t>(order.table_slot)]);
    case OrderKind::kInject:
      return inject(order.injection);
    case OrderKind::kHome:
      return home(time);
    case OrderKind::kLoadPath:
      return take_path(order);
    case OrderKind::kPausePath:
      return follower_->pause(static_cast<std::size_t>(index_));
    case OrderKind::kResumePath:
      return follower_->resume(static_cast<std::size_t>(index_));
    case OrderKind::kResetLearning:
      return reset_learning();
    case OrderKind::kFreezeLearning:
    case OrderKind::kResumeLearning:
      friction_.frozen = order.kind == OrderKind::kFreezeLearning;
      controller_.freeze_learning(friction_.frozen);
      return Reason::kAccepted;
    case OrderKind::kEndStream:
      return ordered_.streamed() ? hold() : Reason::kAccepted;
  }
  return Reason::kUnknownAction;
}

Ruling JointLoop::enable(const CycleTime& time) noexcept {
  if (mode_.is(Mode::kFaulted)) return Reason::kFaulted;
  if (service_ == Service::kEnding) return Reason::kEnding;
  if (!controller_.has_table()) return Reason::kNoTable;
  // A drive that is silent because of a fault says so: the joint then faults, and the fault can be cleared.
  if (mode_.is(Mode::kOff) && watch_.too_many_missed() && reading().fault == ActuatorFault::kNone)
    return Reason::kDriveNotReady;
  const double speed_rad_s = std::abs(measured_velocity_rad_s());
  if (mode_.is(Mode::kOff) && speed_rad_s > config_.standstill_rad_s)
    return {Reason::kMoving, speed_rad_s, config_.standstill_rad_s};
  if (!change_mode(ModeEvent::kEnableOrdered, time)) return Reason::kWrongMode;
  ordered_.forget();
  return Reason::kAccepted;
}

Ruling JointLoop::use_table(const TableSlot& slot) noexcept {
  // At rest a swap is always allowed; under control only while the reference stands still.
  const bool at_standstill = mode_.is(Mode::kHolding);
  if (!at_rest() && !at_standstill) return Reason::kMoving;
  const GainTable& table = slot.table;
  // Less torque than the joint needs to stay where it is would let it fall, and so would a lower limit of the load that it yields to.
  const double holds_Nm = std::abs(motion_.output.torque_Nm);
  if (mode_.controlled() && holds_Nm > table.torque_limit_Nm)
    return {Reason::kOutOfRange, table.torque_limit_Nm, holds_Nm};
  const LoadLimits loads = config_.limits.load.under(config_.controller.torque_limit_with(table));
  if (mode_.controlled() && std::abs(motion_.load_Nm) > loads.load_Nm)
    return {Reason::kOutOfRange, loads.load_Nm, std::abs(motion_.load_Nm)};
  motion_watch_.limit_loads(loads);
  // Scales belong to the rules with which they were learned.
  if (table_ != nullptr && table_->friction_rules_id != slot.friction_rules_id) forget_learned();
  controller_.load(table);
  table_ = &slot;
  // A table with a box is for joints of other inertias than the one that it is designed for.
  const std::optional<LinkModel>& link = config_.controller.link;
  watch_.set_joint(link ? link->motor_inertia_kgm2 + link->link_inertia_kgm2 : table.plant.inertia_kgm2,
                   largest_static_friction_Nm(table.friction));
  return Reason::kAccepted;
}

// Where a table may change, too: what is forgotten makes no torque step at rest.
Ruling JointLoop::reset_learning() noexcept {
  if (!at_rest() && !mode_.is(Mode::kHolding)) return Reason::kMoving;
  forget_learned();
  return Reason::kAccepted;
}

void JointLoop::forget_learned() noexcept {
  controller_.set_learned({});
  friction_ = {.frozen = friction_.frozen};
}

Ruling JointLoop::begin_setpoint(const Order& order, const CycleTime& time) noexcept {
  if (mode_.is(Mode::kFaulted)) return Reason::kFaulted;
  if (service_ == Service::kEnding) return Reason::kEnding;
  // A late packet of a stream that has ended must not set the joint moving again.
  if (!ordered_.takes(order.stream_id, order.begins_stream)) return stream_ended(order.stream_id);
  if (!zero_.known()) return Reason::kNotHomed;
  const std::int64_t in_periods = order.at_cycle == 0 ? 0 : order.at_cycle - time.cycle;
  if (order.at_cycle != 0 && in_periods <= 0) {
    ++late_samples_;
    return {Reason::kTooOld, static_cast<double>(order.at_cycle), static_cast<double>(time.cycle)};
  }
  const double ahead_s = static_cast<double>(in_periods) * config_.controller.period_s;
  if (ahead_s > kFarthestAhead_s) return {Reason::kOutOfRange, ahead_s, kFarthestAhead_s};
  const double target_rad = zero_.to_drive_rad(order.position_rad);
  if (controller_.yields()) return Reason::kMoving;
  if (order.begins_stream && mode_.controlled())
    if (const Ruling ruling = judge_begin(order, target_rad, ahead_s); ruling.reason != Reason::kAccepted)
      return ruling;
  if (into_limit_switch(target_rad - reading().joint_position_rad)) return Reason::kAtLimitSwitch;
  if (!change_mode(ModeEvent::kSetpointAccepted, time)) return Reason::kWrongMode;
  SampleFate fate = SampleFate::kInTime;
  if (order.stream_id == 0)
    controller_.set_target(target_rad,
                           order.speed_limit_rad_s > 0.0 ? order.speed_limit_rad_s : move_speed_rad_s());
  else
    fate = follow_stream(order, target_rad, in_periods);
  if (on_path()) drop_path();
  yield_.reset();
  ordered_.accept({order.position_rad, target_rad, order.stream_id, order.valid_for_s}, time.now_ns);
  if (fate == SampleFate::kLate) ++late_samples_;
  if (fate != SampleFate::kVelocitiesContradict) return Reason::kAccepted;
  controller_.stop();
  ordered_.contradict();
  return Reason::kVelocitiesContradict;
}

// From where the joint will be by then. One that is far away is approached, if the order says so.
Ruling JointLoop::judge_begin(const Order& order, double target_rad, double ahead_s) noexcept {
  const Trajectory& now = controller_.trajectory();
  const double far_rad = std::abs(target_rad - now.position_rad() - ahead_s * now.velocity_rad_s());
  const double limit_rad = config_.limits.following_error_rad;
  approaches_ = far_rad > limit_rad;
  if (approaches_ && !order.approaches) return {Reason::kFarFromJoint, far_rad, limit_rad};
  return Reason::kAccepted;
}

SampleFate JointLoop::follow_stream(const Order& order, double target_rad, std::int64_t in_periods) noexcept {
  if (!order.begins_stream && !motion_.off_stream) approaches_ = false;
  const bool at_move_speed = approaches_ && order.speed_limit_rad_s == 0.0;
  const double speed_rad_s = at_move_speed ? move_speed_rad_s() : order.speed_limit_rad_s;
  return controller_.follow({target_rad,
                             order.velocity_rad_s,
                             order.acceleration_rad_s2,
                             order.derivatives,
                             in_periods,
                             {order.torque_Nm, order.load_inertia_kgm2},
                             order.sent_us},
                            order.begins_stream, speed_rad_s, reachable_range());
}

Ruling JointLoop::stream_ended(std::int64_t stream_id) const noexcept {
  if (!yield_ || stream_id != yielded_stream_) return Reason::kStreamEnded;
  return {Reason::kStreamEnded, std::abs(yield_->load_Nm), yield_->limit_Nm};
}

// As the drive counts it.
PositionRange JointLoop::reachable_range() const noexcept {
  return {zero_.to_drive_rad(config_.limits.position_min_rad),
          zero_.to_drive_rad(config_.limits.position_max_rad)};
}

Reason JointLoop::hold() noexcept {
  if (!mode_.controlled()) return Reason::kWrongMode;
  if (follower_ != nullptr && follower_->end(static_cast<std::size_t>(index_))) return Reason::kAccepted;
  drop_path();
  controller_.stop();
  homing_.abort();
  ordered_.end();
  return Reason::kAccepted;
}

Reason JointLoop::inject(const Injection& injection) noexcept {
  if (injector_ == nullptr) return Reason::kNotSimulated;
  injector_->inject(injection);
  return Reason::kAccepted;
}

Reason JointLoop::clear_fault(const CycleTime& time) noexcept {
  if (!mode_.is(Mode::kFaulted)) return Reason::kWrongMode;
  actuator_->clear_fault();
  watch_.forgive();
  yield_.reset();
  return change_mode(ModeEvent::kFaultCleared, time) ? Reason::kAccepted : Reason::kWrongMode;
}

}  // namespace strainwave
