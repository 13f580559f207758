// SPDX-License-Identifier: BSD-3-Clause
// Bounded queue of messages for the core, with memory allocated by its constructor. Sources take turns: one that sends a thousand
// messages delays another by only one of them. When the queue is full, it loses its own newest messages.
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
    std::uint64_t turn = 0;     ///< round in which its source's turn reaches it
    std::uint64_t arrival = 0;  ///< order within the same turn
  };
  Entry* place_for(const LcmSource& from) noexcept;

  std::vector<Entry> entries_;
  std::vector<WireMessage> messages_;  ///< separate from entries_, which are searched often
  std::uint64_t turn_ = 0;             ///< turn of the message taken last
  std::uint64_t arrivals_ = 0;
  std::uint64_t crowded_out_ = 0;
};

}  // namespace strainwave
