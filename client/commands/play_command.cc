// play: the setpoints of a log as new orders.
#include <fmt/format.h>

#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "client/commands/commands.h"
#include "client/commands/guarded_motion.h"
#include "client/link/exit_status.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

struct TimedSetpoint {
  double at_s = 0.0;  ///< since the first one
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
    // A clock that was set back while recording must not turn the order round.
    const double at_s = std::max(static_cast<double>(event.received_us - first_us) * 1e-6,
                                 setpoints.empty() ? 0.0 : setpoints.back().at_s);
    setpoints.push_back({at_s, *setpoint});
  }
  if (setpoints.empty())
    throw ClientError(ExitStatus::kUsage,
                      fmt::format("{} holds no setpoints of {}", arguments.log.string(), arguments.joint));
  return setpoints;
}

/// Only what was wanted is taken over; who, when and for whom, the sender says anew.
setpoint_v1 order_of(const setpoint_v1& recorded) {
  setpoint_v1 order{};
  order.position_rad = recorded.position_rad;
  order.valid_for_s = recorded.valid_for_s;
  order.speed_limit_rad_s = recorded.speed_limit_rad_s;
  return order;
}

void require_order(Client& client, const std::string& joint, const setpoint_v1& setpoint) {
  setpoint_v1 order = setpoint;
  order.acknowledge = 1;
  require_accepted(client.request(joint, channel_kind::kSetpoint, order), joint, "the first setpoint");
}

/// The daemon refuses to go on with a stream that has expired; a hold says that a new one begins.
void end_expired_stream(Client& client, const std::string& joint) {
  command_v1 order{};
  order.action = static_cast<std::int32_t>(Action::kHold);
  require_accepted(client.request(joint, channel_kind::kCommand, order), joint, "the hold after a stream");
}

void send_all(Client& client, const std::string& joint, const std::vector<TimedSetpoint>& setpoints) {
  const std::int64_t session_id = client.wait_for_joint(joint).state.session_id;
  const Instant start = now();
  const TimedSetpoint* last = nullptr;
  for (const TimedSetpoint& next : setpoints) {
    const Deadline due(next.at_s - seconds_between(start, now()));
    do {
      client.wait_until([] { return false; }, Deadline(std::min(0.02, due.remaining_ms() * 1e-3)));
      require_undisturbed(client, joint, session_id);
    } while (!due.passed());
    const bool stream_ended = last != nullptr && last->setpoint.valid_for_s > 0.0 &&
                              next.at_s - last->at_s > last->setpoint.valid_for_s;
    if (stream_ended) end_expired_stream(client, joint);
    if (last == nullptr)
      require_order(client, joint, order_of(next.setpoint));
    else
      client.send(joint, channel_kind::kSetpoint, order_of(next.setpoint));
    last = &next;
  }
  // The last refusal, if there is one, is on its way.
  client.wait_until([] { return false; }, Deadline(0.1));
  require_undisturbed(client, joint, session_id);
}

}  // namespace

void play(Client& client, const Output& output, const PlayArguments& arguments) {
  if (client.options().key_file.empty())
    throw ClientError(
        ExitStatus::kUsage,
        "play: recorded setpoints are sent only as new orders of somebody: say who with --key FILE");
  const std::vector<TimedSetpoint> setpoints = read_setpoints(arguments);
  say(output,
      fmt::format("{}: {} setpoints over {:.1f} s", arguments.joint, setpoints.size(), setpoints.back().at_s),
      {{"joint", arguments.joint},
       {"setpoints", static_cast<std::int64_t>(setpoints.size())},
       {"duration_s", setpoints.back().at_s}});
  output.stream.flush();
  run_guarded(client, arguments.joint, [&] { send_all(client, arguments.joint, setpoints); });
  say(output, arguments.joint + ": all sent", {{"joint", arguments.joint}, {"sent", true}});
}

}  // namespace strainwave
