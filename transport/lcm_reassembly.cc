// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_reassembly.h"

#include <algorithm>

namespace strainwave {

namespace {

// A program on this machine may send from any loopback address.
std::uint32_t host_of(std::uint32_t address) noexcept {
  constexpr std::uint32_t kLoopbackNet = 127;
  return (address >> 24) == kLoopbackNet ? kLoopbackNet << 24 : address;
}

}  // namespace

LcmReassembly::LcmReassembly(std::size_t largest_message_bytes)
    : largest_message_bytes_(largest_message_bytes) {
  for (Slot& slot : slots_) slot.bytes.resize(largest_message_bytes);
}

std::optional<LcmMessage> LcmReassembly::take(const LcmSource& from, std::span<const std::uint8_t> datagram) {
  const LcmDatagram parsed = parse_lcm_datagram(datagram);
  switch (parsed.kind) {
    case LcmDatagram::Kind::kMalformed:
      ++counts_.malformed;
      return std::nullopt;
    case LcmDatagram::Kind::kShort:
      if (parsed.part.size() <= largest_message_bytes_)
        return LcmMessage{parsed.channel, parsed.part, parsed.sequence};
      ++counts_.too_long;
      return std::nullopt;
    case LcmDatagram::Kind::kFragment:
      return take_fragment(from, parsed);
  }
  return std::nullopt;
}

std::optional<LcmMessage> LcmReassembly::take_fragment(const LcmSource& from, const LcmDatagram& fragment) {
  if (fragment.message_bytes > largest_message_bytes_ || fragment.count > kMaxFragments) {
    ++counts_.too_long;
    return std::nullopt;
  }
  Slot& slot = slot_for(from, fragment);
  Part& part = slot.parts[fragment.number];
  if (slot.state != SlotState::kCollecting || part.here) return std::nullopt;
  if (fragment.number == 0) slot.channel = FixedString<kMaxChannelLength + 1>(fragment.channel);
  part = {fragment.offset, static_cast<std::uint32_t>(fragment.part.size()), true};
  std::copy(fragment.part.begin(), fragment.part.end(), slot.bytes.begin() + fragment.offset);
  if (++slot.parts_here < slot.count) return std::nullopt;
  slot.state = SlotState::kDone;
  if (fits_together(slot))
    return LcmMessage{slot.channel.view(), std::span(slot.bytes).first(slot.message_bytes), slot.sequence};
  ++counts_.malformed;
  return std::nullopt;
}

// Returns the slot that collects this message, or a new one.
LcmReassembly::Slot& LcmReassembly::slot_for(const LcmSource& from, const LcmDatagram& fragment) {
  const auto own = std::find_if(slots_.begin(), slots_.end(), [&](const Slot& slot) {
    return slot.state != SlotState::kFree && slot.source == from;
  });
  if (own != slots_.end() && own->sequence == fragment.sequence &&
      own->message_bytes == fragment.message_bytes && own->count == fragment.count)
    return *own;
  Slot& slot = own != slots_.end() ? *own : slot_to_give_up(host_of(from.address));
  if (slot.state == SlotState::kCollecting) ++counts_.interrupted;
  slot.state = SlotState::kCollecting;
  slot.source = from;
  slot.begun = ++begun_;
  slot.sequence = fragment.sequence;
  slot.message_bytes = fragment.message_bytes;
  slot.count = fragment.count;
  slot.parts_here = 0;
  std::fill_n(slot.parts.begin(), fragment.count, Part{});
  return slot;
}

LcmReassembly::Slot& LcmReassembly::slot_to_give_up(std::uint32_t newcomer) {
  const auto slots_of = [&](std::uint32_t host) {
    return std::count_if(slots_.begin(), slots_.end(),
                         [&](const Slot& slot) {
                           return slot.state == SlotState::kCollecting &&
                                  host_of(slot.source.address) == host;
                         }) +
           (host == newcomer ? 1 : 0);
  };
  Slot* chosen = &slots_.front();
  std::ptrdiff_t chosen_slots = -1;
  for (Slot& slot : slots_) {
    // A slot that collects no message goes first.
    if (slot.state != SlotState::kCollecting) return slot;
    const std::ptrdiff_t held = slots_of(host_of(slot.source.address));
    if (held < chosen_slots || (held == chosen_slots && slot.begun > chosen->begun)) continue;
    chosen = &slot;
    chosen_slots = held;
  }
  return *chosen;
}

// Each part begins where the one before it ends, from the first byte to the last.
bool LcmReassembly::fits_together(const Slot& slot) noexcept {
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < slot.count; ++i) {
    if (slot.parts[i].offset != end) return false;
    end += slot.parts[i].bytes;
  }
  return end == slot.message_bytes;
}

}  // namespace strainwave
