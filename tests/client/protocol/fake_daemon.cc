// SPDX-License-Identifier: BSD-3-Clause
#include "tests/client/protocol/fake_daemon.h"

#include <algorithm>
#include <optional>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "lcmtypes/wire.h"

namespace strainwave {

FakeDaemon::FakeDaemon(Connection& connection, std::string prefix, std::string joint)
    : connection_(connection),
      prefix_(std::move(prefix)),
      joint_(std::move(joint)),
      subscription_(connection.subscribe(prefix_ + "\\." + joint_ + "\\.(SETPOINT|PATH|COMMAND|TABLE|INJECT)",
                                         &FakeDaemon::on_order, this)) {
  state.session_id = 77;
  state.rule_count = 1;
  limits.period_s = 1e-3;
  limits.position_min_rad = -3.0;
  limits.position_max_rad = 3.0;
  limits.speed_limit_rad_s = 2.0;
  limits.torque_limit_Nm = 30.0;
}

void FakeDaemon::publish_state() {
  ++state.cycle;
  connection_.publish(channel(prefix_, joint_, channel_kind::kState), encode(state));
}

void FakeDaemon::publish_state(Mode mode) {
  state.mode = static_cast<std::int32_t>(mode);
  publish_state();
}

void FakeDaemon::publish_limits() {
  limits.session_id = state.session_id;
  connection_.publish(channel(prefix_, joint_, channel_kind::kLimits), encode(limits));
}

void FakeDaemon::show_yield() {
  state.notices = static_cast<std::int32_t>(Notice::kYielded);
  state.yield_load_Nm = -13.1042;
  state.yield_limit_Nm = 12.0;
  state.yield_position_rad = 0.3011;
}

void FakeDaemon::on_order(const ReceivedMessage& message) {
  const auto bytes = message.bytes;
  heard_.push_back({message.channel, {bytes.begin(), bytes.end()}});
  if (drop > 0) {
    --drop;
    return;
  }
  if (const auto setpoint = decode_exactly<setpoint_v1>(bytes)) {
    if (obeys_moves && reason == Reason::kAccepted)
      state.target_position_rad = state.joint_position_rad = setpoint->position_rad;
    answer(setpoint->sender_id, setpoint->sequence);
  } else if (const auto path = decode_exactly<path_v1>(bytes)) {
    answer(path->sender_id, path->sequence);
  } else if (const auto command = decode_exactly<command_v1>(bytes)) {
    answer(command->sender_id, command->sequence);
  } else if (const auto table = decode_exactly<gain_table_v1>(bytes)) {
    answer(table->sender_id, table->sequence);
  } else if (const auto injection = decode_exactly<inject_v1>(bytes)) {
    answer(injection->sender_id, injection->sequence);
  }
}

void FakeDaemon::answer(std::int64_t sender_id, std::int64_t sequence) {
  ack_v1 ack{};
  ack.session_id = state.session_id;
  ack.sender_id = sender_id;
  ack.sequence = sequence + sequence_error;
  ack.last_sequence = last_sequence;
  ack.accepted = reason == Reason::kAccepted ? 1 : 0;
  ack.reason = static_cast<std::int32_t>(reason);
  std::copy_n(text.begin(), std::min(text.size(), sizeof(ack.text)), std::begin(ack.text));
  connection_.publish(channel(prefix_, answers_as.empty() ? joint_ : answers_as, channel_kind::kAck),
                      encode(ack));
  if (after_answer) after_answer();
  for (const Mode mode : modes_after_answer) publish_state(mode);
}

}  // namespace strainwave
