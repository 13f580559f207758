// SPDX-License-Identifier: BSD-3-Clause
// A classic CAN frame with an 11-bit identifier for the simulated nodes. can_port.h converts it for sockets.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace strainwave::can_nodes {

struct Frame {
  std::uint32_t id = 0;
  std::uint8_t length = 0;
  std::array<std::uint8_t, 8> data{};
  bool remote = false;

  Frame() = default;
  Frame(std::uint32_t identifier, std::span<const std::uint8_t> bytes) : id(identifier) {
    for (const std::uint8_t byte : bytes.first(bytes.size() < 8 ? bytes.size() : 8)) data[length++] = byte;
  }
  Frame(std::uint32_t identifier, std::initializer_list<std::uint8_t> bytes)
      : Frame(identifier, std::span<const std::uint8_t>(bytes.begin(), bytes.size())) {}

  std::span<const std::uint8_t> bytes() const { return {data.data(), length}; }
  bool operator==(const Frame&) const = default;
};

/// Appends a number in little-endian order, as in both protocols. `size` is 1 to 8.
template <typename Container>
void append_little_endian(Container& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

inline std::uint64_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = (value << 8) | bytes[i];
  return value;
}

/// A four-byte float.
inline float float_at(const Frame& frame, std::size_t offset) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(little_endian(frame.bytes().subspan(offset, 4))));
}

}  // namespace strainwave::can_nodes
