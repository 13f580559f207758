// SPDX-License-Identifier: BSD-3-Clause
// Parses one untrusted datagram of LCM's wire format over UDP multicast. Allocates nothing and copies nothing: the result
// points into the datagram. All numbers are big-endian.
//
//   short:    u32 0x4c433032 "LC02", u32 sequence, channel, 0, the message
//   fragment: u32 0x4c433033 "LC03", u32 sequence, u32 size of the whole message, u32 offset of this part in it,
//             u16 number of this fragment, u16 count of fragments, in fragment 0 the channel and a zero, the part
//
// Source: LCM 1.3.1, lcm/udpm_util.h (headers) and lcm/lcm_udpm.c (lcm_udpm_publish).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "lcmtypes/channels.h"

namespace strainwave {

inline constexpr std::size_t kLcmFragmentHeaderBytes = 20;

struct LcmDatagram {
  enum class Kind {
    kMalformed,  ///< not LCM's, or it contradicts itself; nothing else is set
    kShort,
    kFragment
  };
  Kind kind = Kind::kMalformed;
  std::uint32_t sequence = 0;
  std::string_view channel;  ///< of a short message and of fragment 0; at most kMaxChannelLength
  std::span<const std::uint8_t> part;
  // For a fragment only; offset + part.size() <= message_bytes, number < count, fragment 0 has offset 0.
  std::uint32_t message_bytes = 0;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 0;
};

/// Returns the size of the longest datagram of a message of `message_bytes`, sent whole or in fragments.
constexpr std::size_t largest_datagram(std::size_t message_bytes) noexcept {
  return kLcmFragmentHeaderBytes + kMaxChannelLength + 1 + message_bytes;
}

/// Reads `datagram`, of any size and content.
LcmDatagram parse_lcm_datagram(std::span<const std::uint8_t> datagram) noexcept;

}  // namespace strainwave
