// SPDX-License-Identifier: BSD-3-Clause
// Datagrams of LCM's wire format for tests, written from LCM 1.3.1's udpm_util.h and independent of our parser.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace strainwave::testing {

using Bytes = std::vector<std::uint8_t>;

inline void put_number(Bytes& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = size; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
}

inline void put_channel(Bytes& bytes, const std::string& channel) {
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
}

inline Bytes short_datagram(const std::string& channel, const Bytes& message, std::uint32_t sequence = 0) {
  Bytes bytes;
  put_number(bytes, 0x4c433032, 4);
  put_number(bytes, sequence, 4);
  put_channel(bytes, channel);
  bytes.insert(bytes.end(), message.begin(), message.end());
  return bytes;
}

struct FragmentHeader {
  std::uint32_t sequence = 0;
  std::uint32_t message_bytes = 0;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 0;
};

/// `body` follows the header unchanged. In fragment 0 it includes the channel.
inline Bytes fragment_datagram(const FragmentHeader& header, const Bytes& body) {
  Bytes bytes;
  put_number(bytes, 0x4c433033, 4);
  put_number(bytes, header.sequence, 4);
  put_number(bytes, header.message_bytes, 4);
  put_number(bytes, header.offset, 4);
  put_number(bytes, header.number, 2);
  put_number(bytes, header.count, 2);
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

/// `message` in fragments of `part_bytes` bytes of it each. The last one may be shorter.
inline std::vector<Bytes> fragments(const std::string& channel, const Bytes& message, std::size_t part_bytes,
                                    std::uint32_t sequence = 0) {
  std::vector<Bytes> datagrams;
  const std::size_t count = (message.size() + part_bytes - 1) / part_bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * part_bytes;
    const std::size_t end = std::min(begin + part_bytes, message.size());
    Bytes body;
    if (i == 0) put_channel(body, channel);
    body.insert(body.end(), message.begin() + static_cast<std::ptrdiff_t>(begin),
                message.begin() + static_cast<std::ptrdiff_t>(end));
    datagrams.push_back(fragment_datagram(
        {sequence, static_cast<std::uint32_t>(message.size()), static_cast<std::uint32_t>(begin),
         static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(count)},
        body));
  }
  return datagrams;
}

/// Makes LCM 1.3.1 write 4 GiB beyond its buffer: two fragments, the second of which ends where 32 bits wrap.
inline std::vector<Bytes> crashing_fragments(const std::string& channel, std::uint32_t sequence) {
  constexpr std::uint32_t kPart = 1000;
  Bytes first;
  put_channel(first, channel);
  first.resize(first.size() + 100);
  return {fragment_datagram({sequence, 5000, 0, 0, 3}, first),
          fragment_datagram({sequence, 5000, UINT32_MAX - kPart + 1, 1, 3}, Bytes(kPart))};
}

/// Bytes that depend on place and seed.
inline Bytes pattern(std::size_t size, std::uint32_t seed = 1) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>((i * 31 + i / 251 + seed * 97) & 0xff);
  return bytes;
}

}  // namespace strainwave::testing
