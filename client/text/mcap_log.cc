// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/mcap_log.h"

#include <algorithm>

#include "lcmtypes/message_json.h"
#include "lcmtypes/message_kinds.h"

namespace strainwave {

namespace {

std::uint64_t since_epoch_ns(std::int64_t time_us) {
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(time_us, 0, INT64_MAX / 1000)) * 1000U;
}

}  // namespace

McapLog::McapLog(const std::filesystem::path& file) : writer_(file, "strainwave " STRAINWAVE_VERSION) {}

bool McapLog::take(const ChannelName& name, const std::string& channel, std::int64_t received_us,
                   std::span<const std::uint8_t> data) {
  return visit_message(name.kind, data, [&]<typename Message>(const Message& message) {
    auto known = channels_.find(channel);
    if (known == channels_.end()) {
      const std::uint16_t id =
          writer_.add_channel(channel, schema_name<Message>(), message_schema<Message>());
      known = channels_.emplace(channel, id).first;
    }
    writer_.write(known->second, since_epoch_ns(received_us), since_epoch_ns(message.utime),
                  message_json(message));
  });
}

}  // namespace strainwave
