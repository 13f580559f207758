// SPDX-License-Identifier: BSD-3-Clause
// Assembles whole messages from LCM's datagrams. The constructor allocates all memory: a fixed number of slots, each with room for
// the largest message. So no number on the wire determines the use of memory. Needs no clock.
//
// A source (address and port) has one slot, because LCM sends one message after the other. Fragments may come in any order and
// more than once. When every slot is taken, the *host* with the most slots, the new one included, loses its oldest slot. So a host
// that opens many slots loses only its own. All of 127.0.0.0/8 is one host.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/fixed_string.h"
#include "lcmtypes/channels.h"
#include "transport/lcm_wire.h"

namespace strainwave {

/// Sender of a datagram: IPv4 address and port, in the host's byte order.
struct LcmSource {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  bool operator==(const LcmSource&) const = default;
};

struct LcmMessage {
  std::string_view channel;
  std::span<const std::uint8_t> bytes;
  std::uint32_t sequence = 0;  ///< number that the sender gave to the message
};

class LcmReassembly {
 public:
  static constexpr std::size_t kSlots = 32;
  /// LCM's smallest fragments carry 1423 bytes (Apple's systems), so no message of ours has more fragments than this.
  static constexpr std::size_t kMaxFragments = 256;

  struct Counts {
    std::uint64_t malformed =
        0;  ///< datagrams that are not LCM's, and messages whose fragments do not fit together
    std::uint64_t too_long = 0;  ///< datagrams of messages with too many bytes or fragments
    std::uint64_t interrupted =
        0;  ///< messages given up: the sender began another one, or another sender needed the slot
  };

  /// Room for messages of at most `largest_message_bytes`.
  explicit LcmReassembly(std::size_t largest_message_bytes);

  /// Takes a datagram. Returns the message that it completes, if any. The message is valid until the next call, and only
  /// as long as `datagram`.
  std::optional<LcmMessage> take(const LcmSource& from, std::span<const std::uint8_t> datagram);

  const Counts& counts() const noexcept { return counts_; }

 private:
  enum class SlotState {
    kFree,
    kCollecting,
    kDone  ///< delivered or refused; late copies of its fragments are ignored
  };
  struct Part {
    std::uint32_t offset = 0;
    std::uint32_t bytes = 0;
    bool here = false;
  };
  struct Slot {
    SlotState state = SlotState::kFree;
    LcmSource source;
    std::uint64_t begun = 0;  ///< order in which messages began
    std::uint32_t sequence = 0;
    std::uint32_t message_bytes = 0;
    std::uint16_t count = 0;
    std::uint16_t parts_here = 0;
    FixedString<kMaxChannelLength + 1> channel;
    std::array<Part, kMaxFragments> parts{};
    std::vector<std::uint8_t> bytes;
  };
  std::optional<LcmMessage> take_fragment(const LcmSource& from, const LcmDatagram& fragment);
  Slot& slot_for(const LcmSource& from, const LcmDatagram& fragment);
  Slot& slot_to_give_up(std::uint32_t newcomer);
  static bool fits_together(const Slot& slot) noexcept;

  std::size_t largest_message_bytes_;
  std::array<Slot, kSlots> slots_;
  std::uint64_t begun_ = 0;
  Counts counts_;
};

}  // namespace strainwave
