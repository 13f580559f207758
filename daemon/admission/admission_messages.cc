// SPDX-License-Identifier: BSD-3-Clause
// Part of admission.h: judges the content of each kind of message, once its envelope has passed.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "base/printable.h"
#include "daemon/admission/admission.h"
#include "daemon/admission/table_admission.h"
#include "daemon/admission/verdict.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/stream_validity.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr double kMaxInjection_s = 3600.0;
// No joint moves faster than this. Below, the joint follows a stream's samples as far as its own limits allow.
constexpr double kMaxVelocity_rad_s = 1000.0;
constexpr double kMaxAcceleration_rad_s2 = 1e6;
// With a lower limit the motion would be too slow to see. This is about a hundredth of the sidereal rate.
constexpr double kLeastSpeedLimit_rad_s = 1e-6;
// In multiples of the joint's inertia. This load leaves about a tenth of the acceleration, and no table is certified for it.
constexpr double kHeaviestLoad = 10.0;

struct Number {
  const char* name;
  double value;
};

std::optional<std::string> complaint_about_numbers(std::initializer_list<Number> numbers) {
  for (const Number& number : numbers)
    if (!std::isfinite(number.value))
      return std::string(number.name) + " = " + std::to_string(number.value) + ": a finite number is allowed";
  return std::nullopt;
}

// Velocity, acceleration and time of a setpoint must be possible. Only setpoints of a stream may have them.
std::optional<std::string> complaint_about_motion(const setpoint_v1& setpoint) {
  std::ostringstream text;
  if (setpoint.derivatives < 0 || setpoint.derivatives > 2)
    text << "derivatives = " << setpoint.derivatives
         << ": 0, 1 (velocity) or 2 (acceleration, too) is allowed";
  else if (setpoint.stream_id == 0 && (setpoint.derivatives != 0 || setpoint.at_cycle != 0))
    text << "a move (stream_id 0) begins at once and ends at rest: derivatives and at_cycle must be 0";
  else if (setpoint.at_cycle < 0)
    text << "at_cycle = " << setpoint.at_cycle << ": a future cycle, or 0 for none, is allowed";
  else if (setpoint.approach != 0 && setpoint.begins_stream == 0)
    text << "approach = " << setpoint.approach
         << ": 0 is allowed, except in the setpoint that begins a stream";
  else if (std::abs(setpoint.velocity_rad_s) > kMaxVelocity_rad_s)
    text << "velocity_rad_s = " << number_text(setpoint.velocity_rad_s) << ": from " << -kMaxVelocity_rad_s
         << " to " << kMaxVelocity_rad_s << " is allowed";
  else if (std::abs(setpoint.acceleration_rad_s2) > kMaxAcceleration_rad_s2)
    text << "acceleration_rad_s2 = " << number_text(setpoint.acceleration_rad_s2) << ": from "
         << -kMaxAcceleration_rad_s2 << " to " << kMaxAcceleration_rad_s2 << " is allowed";
  else if (setpoint.stream_id != 0 && setpoint.at_cycle == 0 && setpoint.utime <= 0)
    text << "at_cycle = 0 and utime = " << setpoint.utime
         << ": a setpoint of a stream needs its cycle (at_cycle), or the time when it was sent (utime, us)";
  else
    return std::nullopt;
  return text.str();
}

// The joint must be able to carry the load of a sample. Only setpoints of a stream may have a load.
std::optional<std::string> complaint_about_load(const setpoint_v1& setpoint, const ExpectedJoint& joint) {
  std::ostringstream text;
  const double heaviest_kgm2 = kHeaviestLoad * joint.plant.inertia_kgm2;
  if (setpoint.stream_id == 0 && (setpoint.torque_Nm != 0.0 || setpoint.load_inertia_kgm2 != 0.0))
    text << "a move (stream_id 0) plans its own torque: torque_Nm and load_inertia_kgm2 must be 0";
  else if (std::abs(setpoint.torque_Nm) > joint.torque_limit_Nm)
    text << "torque_Nm = " << number_text(setpoint.torque_Nm) << ": from "
         << number_text(-joint.torque_limit_Nm) << " to " << number_text(joint.torque_limit_Nm)
         << " is allowed (joint.limits.torque_limit_Nm)";
  else if (setpoint.load_inertia_kgm2 < 0.0 || setpoint.load_inertia_kgm2 > (1.0 + kAtBound) * heaviest_kgm2)
    text << "load_inertia_kgm2 = " << beyond_text(setpoint.load_inertia_kgm2, heaviest_kgm2) << ": from 0 to "
         << bound_text(heaviest_kgm2) << " is allowed (" << kHeaviestLoad << " times the joint's inertia)";
  else
    return std::nullopt;
  return text.str();
}

std::optional<OrderKind> order_of(Action action) {
  switch (action) {
    case Action::kEnable:
      return OrderKind::kEnable;
    case Action::kDisable:
      return OrderKind::kDisable;
    case Action::kHold:
      return OrderKind::kHold;
    case Action::kClearFault:
      return OrderKind::kClearFault;
    case Action::kRevertTable:
      return OrderKind::kUseTable;
    case Action::kHome:
      return OrderKind::kHome;
    case Action::kPause:
      return OrderKind::kPausePath;
    case Action::kResume:
      return OrderKind::kResumePath;
    case Action::kResetLearning:
      return OrderKind::kResetLearning;
    case Action::kFreezeLearning:
      return OrderKind::kFreezeLearning;
    case Action::kResumeLearning:
      return OrderKind::kResumeLearning;
    case Action::kTakeOver:
    case Action::kRelease:
      break;  // admission carries these out, not the loop
  }
  return std::nullopt;
}

}  // namespace

Verdict Admission::judge_setpoint(std::size_t joint, const WireMessage& message) {
  const auto setpoint = decode_exactly<setpoint_v1>(payload(message));
  if (!setpoint) return discard(Reason::kMalformed);
  Requester requester{joint, setpoint->sender_id, setpoint->sequence, setpoint->acknowledge != 0};
  if (auto verdict = check_envelope(
          message, {setpoint->session_id, setpoint->challenge, Role::kOperator, true}, requester))
    return std::move(*verdict);
  if (const auto complaint = complaint_about_numbers({{"position_rad", setpoint->position_rad},
                                                      {"velocity_rad_s", setpoint->velocity_rad_s},
                                                      {"acceleration_rad_s2", setpoint->acceleration_rad_s2},
                                                      {"torque_Nm", setpoint->torque_Nm},
                                                      {"load_inertia_kgm2", setpoint->load_inertia_kgm2},
                                                      {"valid_for_s", setpoint->valid_for_s},
                                                      {"speed_limit_rad_s", setpoint->speed_limit_rad_s}}))
    return refuse(requester, Reason::kNotFinite, *complaint);
  const JointAdmission& limits = joints_[joint];
  std::ostringstream text;
  if (setpoint->position_rad < limits.position_min_rad || setpoint->position_rad > limits.position_max_rad) {
    text << "position_rad = " << number_text(setpoint->position_rad) << ": from "
         << number_text(limits.position_min_rad) << " to " << number_text(limits.position_max_rad)
         << " is allowed (joint.limits.position_min_rad and position_max_rad of " << limits.name << ")";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (setpoint->valid_for_s < 0.0 || setpoint->valid_for_s > kLongestValidFor_s ||
      (setpoint->valid_for_s > 0.0) != (setpoint->stream_id != 0)) {
    text << "valid_for_s = " << number_text(setpoint->valid_for_s)
         << " with stream_id = " << setpoint->stream_id
         << ": a move has 0 for both, a stream has a stream_id and at most " << kLongestValidFor_s << " s";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (const double speed_rad_s = setpoint->speed_limit_rad_s;
      speed_rad_s != 0.0 &&
      !(speed_rad_s >= kLeastSpeedLimit_rad_s && speed_rad_s <= limits.speed_limit_rad_s)) {
    text << "speed_limit_rad_s = " << number_text(speed_rad_s) << ": 0 (no limit of its own) or from "
         << number_text(kLeastSpeedLimit_rad_s) << " to " << number_text(limits.speed_limit_rad_s)
         << " is allowed (joint.limits.speed_limit_rad_s of " << limits.name << ")";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (auto complaint = complaint_about_motion(*setpoint))
    return refuse(requester, Reason::kOutOfRange, *complaint);
  if (auto complaint = complaint_about_load(*setpoint, limits.expected))
    return refuse(requester, Reason::kOutOfRange, *complaint);
  Verdict verdict = pass(requester, OrderKind::kSetpoint, setpoint->challenge);
  verdict.order.velocity_rad_s = setpoint->velocity_rad_s;
  verdict.order.acceleration_rad_s2 = setpoint->acceleration_rad_s2;
  verdict.order.torque_Nm = setpoint->torque_Nm;
  verdict.order.load_inertia_kgm2 = setpoint->load_inertia_kgm2;
  verdict.order.derivatives = setpoint->derivatives;
  verdict.order.at_cycle = setpoint->at_cycle;
  verdict.order.sent_us = setpoint->utime;
  verdict.order.approaches = setpoint->approach != 0;
  verdict.order.stream_id = setpoint->stream_id;
  verdict.order.begins_stream = setpoint->begins_stream != 0;
  verdict.order.position_rad = setpoint->position_rad;
  verdict.order.valid_for_s = setpoint->valid_for_s;
  verdict.order.speed_limit_rad_s = setpoint->speed_limit_rad_s;
  return verdict;
}

Verdict Admission::judge_command(std::size_t joint, const WireMessage& message) {
  const auto command = decode_exactly<command_v1>(payload(message));
  if (!command) return discard(Reason::kMalformed);
  Requester requester{joint, command->sender_id, command->sequence};
  const auto action = static_cast<Action>(command->action);
  const auto kind = order_of(action);
  if (action == Action::kDisable || action == Action::kHold)
    return stop(message, *kind, command->session_id, command->challenge, requester);
  const bool engineers = action == Action::kRevertTable || action == Action::kTakeOver;
  if (auto verdict = check_envelope(message,
                                    {command->session_id, command->challenge,
                                     engineers ? Role::kEngineer : Role::kOperator, kind.has_value()},
                                    requester))
    return std::move(*verdict);
  if (action == Action::kTakeOver || action == Action::kRelease) return change_owner(action, requester);
  if (!kind)
    return refuse(requester, Reason::kUnknownAction,
                  "action = " + std::to_string(command->action) + ": from " +
                      std::to_string(static_cast<int>(Action::kEnable)) + " to " +
                      std::to_string(static_cast<int>(Action::kResumeLearning)) +
                      " is allowed, see docs/commands.md");
  if (action == Action::kPause || action == Action::kResume)
    if (auto verdict = check_path_owner(requester)) return std::move(*verdict);
  Verdict verdict = pass(requester, *kind, command->challenge);
  verdict.revert_table = action == Action::kRevertTable;
  return verdict;
}

Verdict Admission::judge_table_message(std::size_t joint, const WireMessage& message) {
  const auto table_message = decode_exactly<gain_table_v1>(payload(message));
  if (!table_message) return discard(Reason::kMalformed);
  Requester requester{joint, table_message->sender_id, table_message->sequence};
  if (auto verdict = check_envelope(
          message, {table_message->session_id, table_message->challenge, Role::kEngineer, true}, requester))
    return std::move(*verdict);
  auto table = std::make_unique<GainTable>(to_gain_table(*table_message));
  const TableVerdict judged = judge_table_but_box(*table, joints_[joint].expected);
  if (judged.reason != Reason::kAccepted) return refuse(requester, judged.reason, judged.text);
  Verdict verdict = pass(requester, OrderKind::kUseTable, table_message->challenge);
  verdict.text = judged.text;
  verdict.table = std::move(table);
  verdict.proves_box = joints_[joint].expected.law_acts;
  return verdict;
}

Verdict Admission::judge_injection(std::size_t joint, const WireMessage& message) {
  const auto inject = decode_exactly<inject_v1>(payload(message));
  if (!inject) return discard(Reason::kMalformed);
  Requester requester{joint, inject->sender_id, inject->sequence};
  if (auto verdict =
          check_envelope(message, {inject->session_id, inject->challenge, Role::kEngineer, false}, requester))
    return std::move(*verdict);
  if (!joints_[joint].takes_injected_faults)
    return refuse(requester, Reason::kNotSimulated,
                  joints_[joint].name +
                      " has a real drive: faults are injected with joint.driver = \"simulated\" only");
  if (const auto complaint = complaint_about_numbers({{"for_s", inject->for_s}, {"amount", inject->amount}}))
    return refuse(requester, Reason::kNotFinite, *complaint);
  const auto kind = injected_fault_of(inject->kind);
  if (!kind)
    return refuse(requester, Reason::kUnknownAction,
                  "kind = " + std::to_string(inject->kind) + ": from 0 to " +
                      std::to_string(static_cast<int>(InjectedFault::kPowerLost)) +
                      " is allowed, see docs/faults.md");
  const AmountRange range = amount_range(*kind);
  std::ostringstream text;
  if (inject->for_s < 0.0 || inject->for_s > kMaxInjection_s) {
    text << "for_s = " << number_text(inject->for_s) << ": from 0 (until it is ended) to " << kMaxInjection_s
         << " is allowed";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (inject->amount < range.min || inject->amount > range.max) {
    text << "amount = " << number_text(inject->amount) << ": from " << number_text(range.min) << " to "
         << number_text(range.max) << " is allowed for " << to_text(*kind);
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  Verdict verdict = pass(requester, OrderKind::kInject, inject->challenge);
  verdict.order.injection = {*kind, 0.0, inject->for_s, inject->amount};
  return verdict;
}

}  // namespace strainwave
