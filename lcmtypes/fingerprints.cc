// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/fingerprints.h"

#include <array>
#include <optional>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <utility>

#include "lcmtypes/message_kinds.h"

namespace strainwave {

namespace {

constexpr std::size_t kFingerprintBytes = 8;

std::optional<std::uint64_t> fingerprint_of(std::string_view kind) {
  const std::array<std::pair<std::string_view, std::int64_t>, 10> fingerprints{
      {{channel_kind::kState, state_v1::getHash()},
       {channel_kind::kTemperature, temperature_v1::getHash()},
       {channel_kind::kLimits, limits_v1::getHash()},
       {channel_kind::kTiming, timing_v1::getHash()},
       {channel_kind::kSetpoint, setpoint_v1::getHash()},
       {channel_kind::kCommand, command_v1::getHash()},
       {channel_kind::kInject, inject_v1::getHash()},
       {channel_kind::kAck, ack_v1::getHash()},
       {channel_kind::kPath, path_v1::getHash()},
       {channel_kind::kTable, gain_table_v1::getHash()}}};
  for (const auto& [name, fingerprint] : fingerprints)
    if (name == kind) return static_cast<std::uint64_t>(fingerprint);
  return std::nullopt;
}

}  // namespace

bool is_of_another_version(std::string_view kind, std::span<const std::uint8_t> bytes) {
  const auto expected = fingerprint_of(kind);
  if (!expected || bytes.size() < kFingerprintBytes) return false;
  std::uint64_t begins = 0;
  for (const std::uint8_t byte : bytes.first(kFingerprintBytes)) begins = begins << 8 | byte;
  return begins != *expected;
}

}  // namespace strainwave
