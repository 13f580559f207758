// SPDX-License-Identifier: BSD-3-Clause
// Maps each kind of channel to its message type, in one list for recorders and viewers. It omits gain tables and paths, which are
// not displayed. Not real-time.
#pragma once

#include <cstdint>
#include <span>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string_view>

#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

namespace strainwave {

/// Decodes `bytes` from a channel of `kind` and calls visit(message). Returns false, without a call, for another kind or malformed bytes.
template <typename Visit>
bool visit_message(std::string_view kind, std::span<const std::uint8_t> bytes, Visit&& visit) {
  const auto as = [&]<typename Message>() {
    const auto message = decode_exactly<Message>(bytes);
    if (message) visit(*message);
    return message.has_value();
  };
  if (kind == channel_kind::kState) return as.template operator()<state_v1>();
  if (kind == channel_kind::kTemperature) return as.template operator()<temperature_v1>();
  if (kind == channel_kind::kLimits) return as.template operator()<limits_v1>();
  if (kind == channel_kind::kTiming) return as.template operator()<timing_v1>();
  if (kind == channel_kind::kSetpoint) return as.template operator()<setpoint_v1>();
  if (kind == channel_kind::kCommand) return as.template operator()<command_v1>();
  if (kind == channel_kind::kInject) return as.template operator()<inject_v1>();
  if (kind == channel_kind::kAck) return as.template operator()<ack_v1>();
  return false;
}

}  // namespace strainwave
