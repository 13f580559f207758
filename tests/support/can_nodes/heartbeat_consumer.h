// SPDX-License-Identifier: BSD-3-Clause
// Watches the heartbeats that 1016h tells a node to watch. A node is watched from its first heartbeat on; a
// lost one is told once, until it is heard again. Source: CiA 301 (4.2.0), 7.5.2.19.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tests/support/can_nodes/object_dictionary.h"

namespace strainwave::can_nodes {

inline constexpr int kWatchedNodes = 2;

class HeartbeatConsumer {
 public:
  /// Adds 1016h.
  explicit HeartbeatConsumer(ObjectDictionary& dictionary);

  void heard(std::uint8_t node_id, std::int64_t now_us);
  /// 1016h was written: watches anew.
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
