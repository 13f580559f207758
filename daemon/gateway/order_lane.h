// SPDX-License-Identifier: BSD-3-Clause
// Which way a message takes to the core, by its channel and, for a stop, its content. Allocates nothing. Nothing is believed
// here: a message on the wrong lane is refused by the core as on the right one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

enum class OrderLane {
  kNone,   ///< none of the daemon's channels
  kStop,   ///< COMMAND with the action disable or hold: goes before everything else
  kOrder,  ///< every other order
  kState   ///< somebody's STATE
};

/// `prefix` is the daemon's own.
OrderLane lane_of(std::string_view prefix, std::string_view channel,
                  std::span<const std::uint8_t> bytes) noexcept;

}  // namespace strainwave
