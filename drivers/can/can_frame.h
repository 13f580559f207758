// SPDX-License-Identifier: BSD-3-Clause
// A classic CAN frame with an 11-bit identifier. Plain data, real-time safe. Source: ISO 11898-1.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>

namespace strainwave {

inline constexpr std::uint32_t kMaxCanId = 0x7FF;
inline constexpr std::size_t kMaxCanBytes = 8;

struct CanFrame {
  std::uint32_t id = 0;                            ///< 0..kMaxCanId; the lowest has the highest priority
  std::uint8_t size = 0;                           ///< 0..kMaxCanBytes
  std::array<std::uint8_t, kMaxCanBytes> bytes{};  ///< bytes beyond size are 0
  bool remote = false;  ///< remote frame: requests a frame and carries no data; never received

  bool operator==(const CanFrame&) const = default;
  std::span<const std::uint8_t> payload() const noexcept { return {bytes.data(), size}; }
};

/// Reads a little-endian number of `count` <= 8 bytes from `bytes`.
constexpr std::uint64_t little_endian(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = (value << 8U) | bytes[i];
  return value;
}

/// Writes the lowest `count` <= 8 bytes of `value`, little-endian.
constexpr void put_little_endian(std::uint8_t* bytes, std::size_t count, std::uint64_t value) noexcept {
  for (std::size_t i = 0; i < count; ++i, value >>= 8U) bytes[i] = static_cast<std::uint8_t>(value & 0xFFU);
}

}  // namespace strainwave
