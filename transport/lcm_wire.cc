// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_wire.h"

#include <algorithm>
#include <optional>

#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;
constexpr std::uint32_t kFragmentMagic = 0x4c433033;
constexpr std::size_t kShortHeaderBytes = 8;

using Bytes = std::span<const std::uint8_t>;

std::uint16_t u16_at(Bytes bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>((bytes[at] << 8) | bytes[at + 1]);
}

std::uint32_t u32_at(Bytes bytes, std::size_t at) noexcept {
  return (std::uint32_t{u16_at(bytes, at)} << 16) | u16_at(bytes, at + 2);
}

// Takes the channel and its zero from the front of `rest`.
std::optional<std::string_view> take_channel(Bytes& rest) noexcept {
  const Bytes searched = rest.first(std::min(rest.size(), kMaxChannelLength + 1));
  const auto zero = std::find(searched.begin(), searched.end(), std::uint8_t{0});
  if (zero == searched.end()) return std::nullopt;
  const auto length = static_cast<std::size_t>(zero - searched.begin());
  const std::string_view channel(static_cast<const char*>(static_cast<const void*>(rest.data())), length);
  rest = rest.subspan(length + 1);
  return channel;
}

LcmDatagram parse_short(Bytes datagram) noexcept {
  Bytes rest = datagram.subspan(kShortHeaderBytes);
  const auto channel = take_channel(rest);
  if (!channel) return {};
  return {
      .kind = LcmDatagram::Kind::kShort, .sequence = u32_at(datagram, 4), .channel = *channel, .part = rest};
}

LcmDatagram parse_fragment(Bytes datagram) noexcept {
  if (datagram.size() < kLcmFragmentHeaderBytes) return {};
  LcmDatagram parsed{.kind = LcmDatagram::Kind::kFragment,
                     .sequence = u32_at(datagram, 4),
                     .channel = {},
                     .part = datagram.subspan(kLcmFragmentHeaderBytes),
                     .message_bytes = u32_at(datagram, 8),
                     .offset = u32_at(datagram, 12),
                     .number = u16_at(datagram, 16),
                     .count = u16_at(datagram, 18)};
  if (parsed.number >= parsed.count) return {};
  if (parsed.number == 0) {
    const auto channel = take_channel(parsed.part);
    if (!channel || parsed.offset != 0) return {};
    parsed.channel = *channel;
  }
  // In this order, the subtraction cannot wrap around.
  if (parsed.offset > parsed.message_bytes) return {};
  if (parsed.part.size() > parsed.message_bytes - parsed.offset) return {};
  return parsed;
}

}  // namespace

LcmDatagram parse_lcm_datagram(Bytes datagram) noexcept {
  if (datagram.size() < kShortHeaderBytes) return {};
  switch (u32_at(datagram, 0)) {
    case kShortMagic:
      return parse_short(datagram);
    case kFragmentMagic:
      return parse_fragment(datagram);
    default:
      return {};
  }
}

}  // namespace strainwave
