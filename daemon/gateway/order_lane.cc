// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/order_lane.h"

#include <strainwave/command_v1.hpp>

#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

// The last part of <prefix>.<joint>.<kind>, or nothing.
std::string_view kind_of(std::string_view prefix, std::string_view channel) noexcept {
  if (!channel.starts_with(prefix)) return {};
  channel.remove_prefix(prefix.size());
  const std::size_t last_dot = channel.rfind('.');
  const bool has_joint = !channel.empty() && channel.front() == '.' && last_dot > 1;
  return has_joint && channel.find('.', 1) == last_dot ? channel.substr(last_dot + 1) : std::string_view{};
}

bool is_stop(std::span<const std::uint8_t> bytes) noexcept {
  const auto command = decode_exactly<command_v1>(bytes);
  return command && (command->action == static_cast<std::int32_t>(Action::kDisable) ||
                     command->action == static_cast<std::int32_t>(Action::kHold));
}

}  // namespace

OrderLane lane_of(std::string_view prefix, std::string_view channel,
                  std::span<const std::uint8_t> bytes) noexcept {
  const std::string_view kind = kind_of(prefix, channel);
  if (kind == channel_kind::kCommand) return is_stop(bytes) ? OrderLane::kStop : OrderLane::kOrder;
  if (kind == channel_kind::kSetpoint || kind == channel_kind::kTable || kind == channel_kind::kPath ||
      kind == channel_kind::kInject)
    return OrderLane::kOrder;
  return kind == channel_kind::kState ? OrderLane::kState : OrderLane::kNone;
}

}  // namespace strainwave
