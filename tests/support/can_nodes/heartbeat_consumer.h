// SPDX-License-Identifier: BSD-3-Clause
// Watches the heartbeats that object 1016h lists. It watches a node from its first heartbeat on. A lost
// heartbeat is reported once, until the next one arrives. Source: CiA 301 (4.2.0), 7.5.2.19.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tests/support/can_nodes/object_dictionary.h"

namespace strainwave::can_nodes {

inline constexpr int kWatchedNodes = 2;

class HeartbeatConsumer {
 public:
  /// Adds object 1016h to the dictionary.
  explicit HeartbeatConsumer(ObjectDictionary& dictionary);

  void heard(std::uint8_t node_id, std::int64_t now_us);
  /// Starts again after object 1016h was written.
  void restart() { deadline_us_ = {}; }
  /// The next node whose heartbeat is overdue at `now_us`.
  std::optional<std::uint8_t> lost(std::int64_t now_us);
  std::optional<std::int64_t> next_deadline_us() const;

 private:
  std::int64_t entry(int n) const { return dictionary_.number({0x1016, static_cast<std::uint8_t>(n + 1)}); }

  ObjectDictionary& dictionary_;
  std::array<std::optional<std::int64_t>, kWatchedNodes> deadline_us_;
};

}  // namespace strainwave::can_nodes
