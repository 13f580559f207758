#include "client/text/mcap_log.h"

#include <algorithm>

#include "client/text/message_json.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

std::uint64_t since_epoch_ns(std::int64_t time_us) {
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(time_us, 0, INT64_MAX / 1000)) * 1000U;
}

}  // namespace

McapLog::McapLog(const std::filesystem::path& file) : writer_(file, "strainwave " STRAINWAVE_VERSION) {}

template <typename Message>
bool McapLog::write(const std::string& channel, std::int64_t received_us,
                    std::span<const std::uint8_t> data) {
  const auto message = decode_exactly<Message>(data);
  if (!message) return false;
  auto known = channels_.find(channel);
  if (known == channels_.end()) {
    const std::uint16_t id = writer_.add_channel(channel, schema_name<Message>(), message_schema<Message>());
    known = channels_.emplace(channel, id).first;
  }
  writer_.write(known->second, since_epoch_ns(received_us), since_epoch_ns(message->utime),
                message_json(*message));
  return true;
}

bool McapLog::take(const ChannelName& name, const std::string& channel, std::int64_t received_us,
                   std::span<const std::uint8_t> data) {
  if (name.kind == channel_kind::kState) return write<state_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kTemperature) return write<temperature_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kLimits) return write<limits_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kTiming) return write<timing_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kSetpoint) return write<setpoint_v2>(channel, received_us, data);
  if (name.kind == channel_kind::kCommand) return write<command_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kInject) return write<inject_v1>(channel, received_us, data);
  if (name.kind == channel_kind::kAck) return write<ack_v1>(channel, received_us, data);
  return false;
}

}  // namespace strainwave
