// SPDX-License-Identifier: BSD-3-Clause
// Chooses the lane of a message to the core, by its channel and, for a stop, its content. Allocates nothing. The choice involves
// no trust: the core checks the messages of both lanes alike.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

enum class OrderLane {
  kNone,   ///< not a channel of the daemon
  kStop,   ///< COMMAND with the action disable or hold: goes before everything else
  kOrder,  ///< every other order
  kState   ///< a STATE message of any sender
};

/// `prefix` is the daemon's own.
OrderLane lane_of(std::string_view prefix, std::string_view channel,
                  std::span<const std::uint8_t> bytes) noexcept;

}  // namespace strainwave
