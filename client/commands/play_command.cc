// SPDX-License-Identifier: BSD-3-Clause
// play: sends the setpoints of a log as new orders.
#include <fmt/format.h>

#include <strainwave/setpoint_v1.hpp>

#include "base/printable.h"
#include "client/commands/commands.h"
#include "client/commands/guarded_motion.h"
#include "client/protocol/orders.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/wire.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

struct TimedSetpoint {
  double at_s = 0.0;  ///< time since the first setpoint
  setpoint_v1 setpoint{};
};

std::vector<TimedSetpoint> read_setpoints(const PlayArguments& arguments) {
  std::vector<TimedSetpoint> setpoints;
  EventLogReader reader(arguments.log);
  std::int64_t first_us = 0;
  for (LogEvent event; reader.next(event);) {
    const auto name = parse_channel(event.channel);
    if (!name || name->joint != arguments.joint || name->kind != channel_kind::kSetpoint) continue;
    const auto setpoint = decode_exactly<setpoint_v1>(event.data);
    if (!setpoint) continue;
    if (setpoints.empty()) first_us = event.received_us;
    // If the clock was set back during recording, the setpoints keep their order.
    const double at_s = std::max(static_cast<double>(event.received_us - first_us) * 1e-6,
                                 setpoints.empty() ? 0.0 : setpoints.back().at_s);
    setpoints.push_back({at_s, *setpoint});
  }
  require_undamaged(reader, arguments.log);
  if (setpoints.empty())
    throw ClientError(ExitStatus::kUsage,
                      fmt::format("{} holds no setpoints of {}", arguments.log.string(), arguments.joint));
  return setpoints;
}

/// Takes over only the wanted motion. The sender sets identity, time and session anew. The cycle of a sample
/// belongs to the recorded session, so it is left out.
setpoint_v1 order_of(const setpoint_v1& recorded) {
  setpoint_v1 order{};
  order.position_rad = recorded.position_rad;
  order.velocity_rad_s = recorded.velocity_rad_s;
  order.acceleration_rad_s2 = recorded.acceleration_rad_s2;
  order.torque_Nm = recorded.torque_Nm;
  order.load_inertia_kgm2 = recorded.load_inertia_kgm2;
  order.derivatives = recorded.derivatives;
  order.valid_for_s = recorded.valid_for_s;
  order.speed_limit_rad_s = recorded.speed_limit_rad_s;
  return order;
}

/// The first setpoint, and each that begins a stream, must not get lost. Its answer is required.
void require_order(Client& client, const std::string& joint, setpoint_v1 order) {
  order.acknowledge = 1;
  order.begins_stream = order.stream_id != 0 ? 1 : 0;
  order.approach = order.begins_stream;
  require_accepted(client.request(joint, channel_kind::kSetpoint, order), joint,
                   "the first setpoint of a motion");
}

void send_all(Client& client, const std::string& joint, const std::vector<TimedSetpoint>& setpoints) {
  GuardedJoint guarded(client, joint, "follow the recording to its end");
  const Instant start = now();
  const TimedSetpoint* last = nullptr;
  std::int64_t stream_id = 0;
  for (const TimedSetpoint& next : setpoints) {
    const Deadline due(next.at_s - seconds_between(start, now()));
    do {
      client.wait_until([] { return false; }, Deadline(std::min(0.02, due.remaining_ms() * 1e-3)));
      guarded.require_undisturbed();
    } while (!due.passed());
    const bool streamed = next.setpoint.stream_id != 0;
    const bool begins = streamed && (last == nullptr || last->setpoint.stream_id != next.setpoint.stream_id ||
                                     next.at_s - last->at_s > last->setpoint.valid_for_s);
    if (begins) stream_id = client.new_stream();
    setpoint_v1 order = order_of(next.setpoint);
    order.stream_id = streamed ? stream_id : 0;
    if (last == nullptr || begins) {
      require_order(client, joint, order);
      guarded.accepted();
    } else {
      client.send(joint, channel_kind::kSetpoint, order);
    }
    last = &next;
  }
  // Waits for a refusal of the last setpoint, which may still be on its way.
  client.wait_until([] { return false; }, Deadline(0.1));
  guarded.require_undisturbed();
}

}  // namespace

void play(Client& client, const Output& output, const PlayArguments& arguments) {
  if (client.options().key_file.empty())
    throw ClientError(
        ExitStatus::kUsage,
        "play: recorded setpoints are sent only as new, signed orders: give the key with --key FILE");
  const std::vector<TimedSetpoint> setpoints = read_setpoints(arguments);
  say(output,
      fmt::format("{}: {} over {:.1f} s", arguments.joint, counted(setpoints.size(), "setpoint"),
                  setpoints.back().at_s),
      {{"joint", arguments.joint},
       {"setpoints", static_cast<std::int64_t>(setpoints.size())},
       {"duration_s", setpoints.back().at_s}});
  output.stream.flush();
  run_guarded(client, arguments.joint, [&] { send_all(client, arguments.joint, setpoints); });
  say(output, arguments.joint + ": all setpoints sent", {{"joint", arguments.joint}, {"sent", true}});
}

}  // namespace strainwave
