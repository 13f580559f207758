// SPDX-License-Identifier: BSD-3-Clause
// Hostile datagrams that an attacker on this machine can send to LCM's port. Reproducible.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace strainwave::testing {

class HostileDatagrams {
 public:
  explicit HostileDatagrams(std::uint64_t seed) : random_(seed) {}

  /// The next one: malformed, truncated, oversized, a fragment with a false header, or a correct LCM packet
  /// with hostile content on one of the daemon's channels. Up to 65507 bytes.
  const std::vector<std::uint8_t>& next();

 private:
  void put_u16(std::uint16_t value);
  void put_u32(std::uint32_t value);
  void put_text(const std::string& text, bool terminated);
  void put_random(std::size_t size);
  std::string some_channel();
  std::uint32_t some_size();
  void noise();
  void short_message();
  void fragment();
  void crashing_fragment();
  void order_with_random_fields();

  std::mt19937_64 random_;
  std::uint32_t sequence_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint8_t> second_;  ///< second one of a pair
};

/// Sends `count` of them to LCM's usual group and port, at most `per_s` per second on average, half to the
/// group and half to this host's own address. Returns the number of datagrams that the system accepted.
std::int64_t send_hostile_datagrams(std::int64_t count, std::uint64_t seed, double per_s);

}  // namespace strainwave::testing
