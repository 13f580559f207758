// SPDX-License-Identifier: BSD-3-Clause
// Lists every field of the messages that people read, by name and in the message's order. CSV and JSON are made from these lists. They
// omit key_id and signature, which mean nothing to a reader. A test compares the lists with lcmtypes/*.lcm. Not real-time.
#pragma once

#include <span>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string_view>

#include "lcmtypes/state_fields.h"

namespace strainwave {

namespace field {
/// Returns the text in a byte array, up to its first zero.
template <std::size_t size>
std::string_view text(const std::uint8_t (&bytes)[size]) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as characters
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  return all.substr(0, all.find('\0'));
}
}  // namespace field

/// Each overload calls visit(name, value): a number, a std::span of numbers, or text as a std::string_view.
template <typename Visit>
void visit_fields(const state_v1& message, Visit&& visit) {
  visit_state_fields(message, visit);
}

template <typename Visit>
void visit_fields(const temperature_v1& message, Visit&& visit) {
  visit("utime", message.utime);
  visit("temperature_measured_C", message.temperature_measured_C);
  visit("temperature_used_C", message.temperature_used_C);
  visit("age_s", message.age_s);
  visit("status", message.status);
}

template <typename Visit>
void visit_fields(const timing_v1& message, Visit&& visit) {
  visit("utime", message.utime);
  visit("session_id", message.session_id);
  visit("cycles", message.cycles);
  visit("overruns", message.overruns);
  visit("page_faults", message.page_faults);
  visit("state_records_dropped", message.state_records_dropped);
  visit("period_s", message.period_s);
  visit("real_time", message.real_time);
  visit("joint_count", message.joint_count);
  visit("wakeup_latency_max_ns", message.wakeup_latency_max_ns);
  visit("execution_time_max_ns", message.execution_time_max_ns);
  visit("position_delay_max_ns", message.position_delay_max_ns);
  visit("wakeup_latency_count", std::span(message.wakeup_latency_count));
  visit("execution_time_count", std::span(message.execution_time_count));
  visit("period_error_count", std::span(message.period_error_count));
  visit("position_delay_count", std::span(message.position_delay_count));
  visit("rejects", std::span(message.rejects));
}

template <typename Visit>
void visit_fields(const limits_v1& message, Visit&& visit) {
  visit("utime", message.utime);
  visit("session_id", message.session_id);
  visit("position_min_rad", message.position_min_rad);
  visit("position_max_rad", message.position_max_rad);
  visit("speed_limit_rad_s", message.speed_limit_rad_s);
  visit("acceleration_rad_s2", message.acceleration_rad_s2);
  visit("deceleration_rad_s2", message.deceleration_rad_s2);
  visit("torque_limit_Nm", message.torque_limit_Nm);
  visit("overspeed_rad_s", message.overspeed_rad_s);
  visit("following_error_rad", message.following_error_rad);
  visit("temperature_limit_C", message.temperature_limit_C);
  visit("period_s", message.period_s);
  visit("inertia_kgm2", message.inertia_kgm2);
  visit("gear_ratio", message.gear_ratio);
  visit("joint_model", field::text(message.joint_model));
}

namespace field {
/// Visits the fields at the beginning of every order.
template <typename Order, typename Visit>
void visit_envelope(const Order& order, Visit&& visit) {
  visit("utime", order.utime);
  visit("session_id", order.session_id);
  visit("challenge", order.challenge);
  visit("sender_id", order.sender_id);
  visit("sequence", order.sequence);
}
}  // namespace field

template <typename Visit>
void visit_fields(const setpoint_v1& message, Visit&& visit) {
  field::visit_envelope(message, visit);
  visit("stream_id", message.stream_id);
  visit("position_rad", message.position_rad);
  visit("velocity_rad_s", message.velocity_rad_s);
  visit("acceleration_rad_s2", message.acceleration_rad_s2);
  visit("torque_Nm", message.torque_Nm);
  visit("load_inertia_kgm2", message.load_inertia_kgm2);
  visit("at_cycle", message.at_cycle);
  visit("derivatives", message.derivatives);
  visit("valid_for_s", message.valid_for_s);
  visit("speed_limit_rad_s", message.speed_limit_rad_s);
  visit("begins_stream", message.begins_stream);
  visit("approach", message.approach);
  visit("acknowledge", message.acknowledge);
}

template <typename Visit>
void visit_fields(const command_v1& message, Visit&& visit) {
  field::visit_envelope(message, visit);
  visit("action", message.action);
}

template <typename Visit>
void visit_fields(const inject_v1& message, Visit&& visit) {
  field::visit_envelope(message, visit);
  visit("kind", message.kind);
  visit("for_s", message.for_s);
  visit("amount", message.amount);
}

template <typename Visit>
void visit_fields(const ack_v1& message, Visit&& visit) {
  visit("utime", message.utime);
  visit("session_id", message.session_id);
  visit("sender_id", message.sender_id);
  visit("sequence", message.sequence);
  visit("last_sequence", message.last_sequence);
  visit("accepted", message.accepted);
  visit("reason", message.reason);
  visit("text", field::text(message.text));
}

}  // namespace strainwave
