// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "daemon/realtime/joint/joint_in_loop.h"
#include "daemon/realtime/path/path_follower.h"

namespace strainwave {

namespace {

constexpr double kFarthestAhead_s = 1.0;  // for a setpoint with at_cycle
// A path must begin where the joint holds, within this tolerance. The setpoint then makes up for the difference.
constexpr double kBeginsWithin_rad = 1e-3;

double largest_static_friction_Nm(const FuzzyFriction& friction) noexcept {
  double largest_Nm = 0.0;
  for (std::int32_t i = 0; i < friction.rule_count; ++i)
    largest_Nm = std::max(largest_Nm, friction.rules[static_cast<std::size_t>(i)].friction.static_Nm);
  return largest_Nm;
}

double move_speed_rad_s(const JointInLoop& joint) noexcept {
  return joint.config.move_speed_share * joint.config.controller.motion.velocity_rad_s;
}

Ruling enable(JointInLoop& joint, const CycleTime& time) noexcept {
  if (joint.mode.is(Mode::kFaulted)) return Reason::kFaulted;
  if (joint.ending) return Reason::kEnding;
  if (joint.law.table() == nullptr) return Reason::kNoTable;
  // A drive that is silent because of a fault reports it: the enabled joint then faults, and the fault can be cleared.
  if (joint.mode.is(Mode::kOff) && joint.drive.too_many_missed() &&
      joint.drive.reading().fault == ActuatorFault::kNone)
    return Reason::kDriveNotReady;
  const double speed_rad_s = std::abs(joint.velocity_rad_s());
  if (joint.mode.is(Mode::kOff) && speed_rad_s > joint.config.standstill_rad_s)
    return {Reason::kMoving, speed_rad_s, joint.config.standstill_rad_s};
  if (!joint.change_mode(ModeEvent::kEnableOrdered, time)) return Reason::kWrongMode;
  joint.ordered.forget();
  return Reason::kAccepted;
}

Ruling use_table(JointInLoop& joint, const TableSlot& slot) noexcept {
  // At rest a swap is always allowed; under control only while the reference stands still.
  const bool at_standstill = joint.mode.is(Mode::kHolding);
  if (!joint.at_rest() && !at_standstill) return Reason::kMoving;
  const GainTable& table = slot.table;
  // A torque limit below the holding torque would let the joint fall. So would a load limit below its present load.
  const double holds_Nm = std::abs(joint.law.motion().output.torque_Nm);
  if (joint.mode.controlled() && holds_Nm > table.torque_limit_Nm)
    return {Reason::kOutOfRange, table.torque_limit_Nm, holds_Nm};
  const LoadLimits loads = joint.config.limits.load.under(joint.config.controller.torque_limit_with(table));
  if (joint.mode.controlled() && std::abs(joint.law.motion().load_Nm) > loads.load_Nm)
    return {Reason::kOutOfRange, loads.load_Nm, std::abs(joint.law.motion().load_Nm)};
  joint.motion_watch.limit_loads(loads);
  joint.law.use_table(slot);
  // A table with a box also fits joints of other inertias than its own, so a flexible joint uses its configured inertia.
  const std::optional<LinkModel>& link = joint.config.controller.link;
  joint.drive.set_joint(link ? link->motor_inertia_kgm2 + link->link_inertia_kgm2 : table.plant.inertia_kgm2,
                        largest_static_friction_Nm(table.friction));
  return Reason::kAccepted;
}

// Allowed in the same modes as a new table: at rest, forgetting makes no torque step.
Ruling reset_learning(JointInLoop& joint) noexcept {
  if (!joint.at_rest() && !joint.mode.is(Mode::kHolding)) return Reason::kMoving;
  joint.law.forget_learned();
  return Reason::kAccepted;
}

Ruling stream_ended(JointInLoop& joint, std::int64_t stream_id) noexcept {
  if (!joint.yield || stream_id != joint.stream.yielded_id) return Reason::kStreamEnded;
  return {Reason::kStreamEnded, std::abs(joint.yield->load_Nm), joint.yield->limit_Nm};
}

// Compares the start of a stream with where the joint will be by then. The joint approaches a distant start only if the order says so.
Ruling judge_begin(JointInLoop& joint, const Order& order, double target_rad, double ahead_s) noexcept {
  const Trajectory& now = joint.law.controller().plan().trajectory();
  const double far_rad = std::abs(target_rad - now.position_rad() - ahead_s * now.velocity_rad_s());
  const double limit_rad = joint.config.limits.following_error_rad;
  joint.stream.approaches = far_rad > limit_rad;
  if (joint.stream.approaches && !order.approaches) return {Reason::kFarFromJoint, far_rad, limit_rad};
  return Reason::kAccepted;
}

SampleFate follow_stream(JointInLoop& joint, const Order& order, double target_rad,
                         std::int64_t in_periods) noexcept {
  if (!order.begins_stream && !joint.law.motion().off_stream) joint.stream.approaches = false;
  const bool at_move_speed = joint.stream.approaches && order.speed_limit_rad_s == 0.0;
  const double speed_rad_s = at_move_speed ? move_speed_rad_s(joint) : order.speed_limit_rad_s;
  return joint.law.controller().follow({target_rad,
                                        order.velocity_rad_s,
                                        order.acceleration_rad_s2,
                                        order.derivatives,
                                        in_periods,
                                        {order.torque_Nm, order.load_inertia_kgm2},
                                        order.sent_us},
                                       order.begins_stream, speed_rad_s, joint.reachable_range());
}

Ruling begin_setpoint(JointInLoop& joint, const Order& order, const CycleTime& time) noexcept {
  if (joint.mode.is(Mode::kFaulted)) return Reason::kFaulted;
  if (joint.ending) return Reason::kEnding;
  // A late packet of a stream that has ended must not set the joint moving again.
  if (!joint.ordered.takes(order.stream_id, order.begins_stream)) return stream_ended(joint, order.stream_id);
  if (!joint.zero.known()) return Reason::kNotHomed;
  const std::int64_t in_periods = order.at_cycle == 0 ? 0 : order.at_cycle - time.cycle;
  if (order.at_cycle != 0 && in_periods <= 0) {
    ++joint.stream.late_samples;
    return {Reason::kCycleIsOver, static_cast<double>(order.at_cycle), static_cast<double>(time.cycle)};
  }
  const double ahead_s = static_cast<double>(in_periods) * joint.config.controller.period_s;
  if (ahead_s > kFarthestAhead_s) return {Reason::kOutOfRange, ahead_s, kFarthestAhead_s};
  const double target_rad = joint.zero.to_drive_rad(order.position_rad);
  if (joint.law.controller().yields()) return Reason::kMoving;
  if (order.begins_stream && joint.mode.controlled())
    if (const Ruling ruling = judge_begin(joint, order, target_rad, ahead_s);
        ruling.reason != Reason::kAccepted)
      return ruling;
  if (joint.drive.reading().inputs.limit_towards(target_rad - joint.drive.position_rad()))
    return Reason::kAtLimitSwitch;
  if (!joint.change_mode(ModeEvent::kSetpointAccepted, time)) return Reason::kWrongMode;
  SampleFate fate = SampleFate::kInTime;
  if (order.stream_id == 0)
    joint.law.controller().set_target(
        target_rad, order.speed_limit_rad_s > 0.0 ? order.speed_limit_rad_s : move_speed_rad_s(joint));
  else
    fate = follow_stream(joint, order, target_rad, in_periods);
  if (joint.ordered.on_path()) joint.drop_path();
  joint.yield.reset();
  joint.ordered.accept({order.position_rad, target_rad, order.stream_id, order.valid_for_s}, time.now_ns);
  if (fate == SampleFate::kLate) ++joint.stream.late_samples;
  if (fate != SampleFate::kVelocitiesContradict) return Reason::kAccepted;
  const double ratio = joint.law.controller().plan().trajectory().velocity_ratio();
  joint.law.controller().stop();
  joint.ordered.contradict();
  return {Reason::kVelocitiesContradict, ratio, ratio != 0.0 ? 1.0 : 0.0};
}

Reason hold(JointInLoop& joint) noexcept {
  if (!joint.mode.controlled()) return Reason::kWrongMode;
  joint.end_orders();
  joint.law.controller().stop();
  joint.homing.abort();
  return Reason::kAccepted;
}

Ruling take_path(JointInLoop& joint, const Order& order) noexcept {
  if (joint.mode.is(Mode::kFaulted)) return Reason::kFaulted;
  const LoadedPath& offered = joint.path_slots.at(order.path_slot);
  const Ruling ruling = may_begin_path(joint, offered);
  if (ruling.reason != Reason::kAccepted) return ruling;
  joint.path = &offered;
  joint.path_slots.use(order.path_slot);
  return Reason::kAccepted;
}

Reason clear_fault(JointInLoop& joint, const CycleTime& time) noexcept {
  if (!joint.mode.is(Mode::kFaulted)) return Reason::kWrongMode;
  joint.drive.clear_fault();
  joint.yield.reset();
  return joint.change_mode(ModeEvent::kFaultCleared, time) ? Reason::kAccepted : Reason::kWrongMode;
}

}  // namespace

Ruling may_begin_path(const JointInLoop& joint, const LoadedPath& path) noexcept {
  if (joint.ending) return Reason::kEnding;
  if (!joint.zero.known()) return Reason::kNotHomed;
  if (joint.mode.is(Mode::kTracking)) return Reason::kMoving;
  if (!joint.mode.is(Mode::kHolding)) return Reason::kWrongMode;
  const double begins_rad = joint.zero.to_drive_rad(path.path.knots[0].position_rad);
  const double off_rad = std::abs(begins_rad - joint.law.controller().plan().trajectory().target_rad());
  if (!(off_rad <= kBeginsWithin_rad)) return {Reason::kOutOfRange, off_rad, kBeginsWithin_rad};
  return Reason::kAccepted;
}

Ruling obey(JointInLoop& joint, const Order& order, const CycleTime& time,
            std::span<const TableSlot> tables) noexcept {
  switch (order.kind) {
    case OrderKind::kEnable:
      return enable(joint, time);
    case OrderKind::kDisable:
      return joint.change_mode(ModeEvent::kDisableOrdered, time) ? Reason::kAccepted : Reason::kWrongMode;
    case OrderKind::kHold:
      return hold(joint);
    case OrderKind::kClearFault:
      return clear_fault(joint, time);
    case OrderKind::kSetpoint:
      return begin_setpoint(joint, order, time);
    case OrderKind::kUseTable:
      return use_table(joint, tables[static_cast<std::size_t>(order.table_slot)]);
    case OrderKind::kInject:
      return joint.drive.inject(order.injection) ? Reason::kAccepted : Reason::kNotSimulated;
    case OrderKind::kHome:
      return begin_homing(joint, time);
    case OrderKind::kLoadPath:
      return take_path(joint, order);
    case OrderKind::kPausePath:
      return joint.follower->pause(static_cast<std::size_t>(joint.index));
    case OrderKind::kResumePath:
      return joint.follower->resume(static_cast<std::size_t>(joint.index));
    case OrderKind::kResetLearning:
      return reset_learning(joint);
    case OrderKind::kFreezeLearning:
    case OrderKind::kResumeLearning:
      joint.law.controller().friction().freeze(order.kind == OrderKind::kFreezeLearning);
      return Reason::kAccepted;
    case OrderKind::kEndStream:
      return joint.ordered.streamed() ? hold(joint) : Reason::kAccepted;
  }
  return Reason::kUnknownAction;
}

}  // namespace strainwave
