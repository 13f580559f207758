// SPDX-License-Identifier: BSD-3-Clause
// Converts bytes on the wire to and from a generated message. Every type has fixed-size fields, so a message of another length
// is malformed by definition. Not real-time. Needs only the header of the LCM library.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strainwave {

/// No message of ours is longer.
inline constexpr std::size_t kLargestMessageBytes = 14336;

/// Returns the message in `bytes`, or nothing when length or fingerprint is not exactly that of T.
template <typename T>
std::optional<T> decode_exactly(std::span<const std::uint8_t> bytes) {
  T message{};
  const int size = message.getEncodedSize();
  if (bytes.size() != static_cast<std::size_t>(size)) return std::nullopt;
  if (message.decode(bytes.data(), 0, size) != size) return std::nullopt;
  return message;
}

/// Returns the wire form of `message`.
template <typename T>
std::vector<std::uint8_t> encode(const T& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace strainwave
