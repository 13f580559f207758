// SPDX-License-Identifier: BSD-3-Clause
// What waits for the core, at most so many messages, of memory that is taken when the queue is made. Sources take turns: one that
// sends a thousand messages delays another by one of them, and when the queue is full it loses its own newest.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "daemon/gateway/shared_memory.h"
#include "transport/lcm_reassembly.h"

namespace strainwave {

class OrderQueue {
 public:
  explicit OrderQueue(std::size_t capacity) : entries_(capacity), messages_(capacity) {}

  /// Puts in a message of at most WireMessage::kMaxBytes; the channel has at most kMaxChannelLength characters.
  void push(const LcmSource& from, std::string_view channel, std::span<const std::uint8_t> bytes) noexcept;
  /// Takes out the next one. False when there is none.
  bool pop(WireMessage& into) noexcept;

  /// Messages lost because the queue was full.
  std::uint64_t crowded_out() const noexcept { return crowded_out_; }

 private:
  struct Entry {
    bool waits = false;
    LcmSource source;
    std::uint64_t turn = 0;     ///< in which round its source's turn comes to it
    std::uint64_t arrival = 0;  ///< among those of the same turn the first
  };
  Entry* place_for(const LcmSource& from) noexcept;

  std::vector<Entry> entries_;
  std::vector<WireMessage> messages_;  ///< beside entries_, which are searched often
  std::uint64_t turn_ = 0;             ///< of the message that was taken last
  std::uint64_t arrivals_ = 0;
  std::uint64_t crowded_out_ = 0;
};

}  // namespace strainwave
