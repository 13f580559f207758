// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/order_queue.h"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace strainwave {

void OrderQueue::push(const LcmSource& from, std::string_view channel,
                      std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() > WireMessage::kMaxBytes) return;
  Entry* entry = place_for(from);
  if (entry == nullptr) return;
  // One turn after its source's last message: start-time fair queueing with equal costs for all messages.
  std::uint64_t turn = turn_;
  for (const Entry& other : entries_)
    if (other.waits && other.source == from) turn = std::max(turn, other.turn);
  *entry = {true, from, turn + 1, ++arrivals_};
  WireMessage& message = messages_[static_cast<std::size_t>(entry - entries_.data())];
  message.channel = FixedString<64>(channel);
  message.source = std::uint64_t{from.address} << 16U | from.port;
  message.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), message.bytes.begin());
}

bool OrderQueue::pop(WireMessage& into) noexcept {
  Entry* next = nullptr;
  for (Entry& entry : entries_)
    if (entry.waits &&
        (next == nullptr || std::tie(entry.turn, entry.arrival) < std::tie(next->turn, next->arrival)))
      next = &entry;
  if (next == nullptr) return false;
  next->waits = false;
  turn_ = next->turn;
  const WireMessage& message = messages_[static_cast<std::size_t>(next - entries_.data())];
  into.channel = message.channel;
  into.source = message.source;
  into.size = message.size;
  std::memcpy(into.bytes.data(), message.bytes.data(), message.size);
  return true;
}

// Returns a free place. In a full queue, returns the place with the last turn if this message's turn would come earlier. It holds
// the newest message of the sender with the most messages.
OrderQueue::Entry* OrderQueue::place_for(const LcmSource& from) noexcept {
  Entry* last = nullptr;
  std::uint64_t own_turn = turn_;
  for (Entry& entry : entries_) {
    if (!entry.waits) return &entry;
    if (entry.source == from) own_turn = std::max(own_turn, entry.turn);
    if (last == nullptr || std::tie(entry.turn, entry.arrival) > std::tie(last->turn, last->arrival))
      last = &entry;
  }
  ++crowded_out_;
  return last != nullptr && own_turn + 1 < last->turn ? last : nullptr;
}

}  // namespace strainwave
