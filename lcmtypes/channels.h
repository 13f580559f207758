// SPDX-License-Identifier: BSD-3-Clause
// Channel names: <prefix>.<joint>.<KIND>, and <prefix>.TIMING for the daemon as a whole. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strainwave {

/// Last part of a channel name.
namespace channel_kind {
inline constexpr std::string_view kState = "STATE";
inline constexpr std::string_view kTemperature = "TEMPERATURE";
inline constexpr std::string_view kLimits = "LIMITS";
inline constexpr std::string_view kTiming = "TIMING";
inline constexpr std::string_view kSetpoint = "SETPOINT";
inline constexpr std::string_view kCommand = "COMMAND";
inline constexpr std::string_view kTable = "TABLE";
inline constexpr std::string_view kPath = "PATH";
inline constexpr std::string_view kInject = "INJECT";
inline constexpr std::string_view kAck = "ACK";
}  // namespace channel_kind

/// LCM's own bound on a channel name, without the terminating zero.
inline constexpr std::size_t kMaxChannelLength = 63;

struct ChannelName {
  std::string prefix;
  std::string joint;  ///< empty for <prefix>.TIMING
  std::string kind;
};

/// Whether `name` can be a prefix or joint name: 1 to 24 of A-Z a-z 0-9 _ and -, not - first. A joint "--all" would look like an option.
bool is_valid_name(std::string_view name);

std::string channel(std::string_view prefix, std::string_view joint, std::string_view kind);
std::string timing_channel(std::string_view prefix);

/// Returns the parts of a channel name, or nothing for a name of another form.
std::optional<ChannelName> parse_channel(std::string_view name);

/// Returns a regular expression for LCM's subscribe(): one kind of channel of every joint under `prefix`. The prefix
/// "[^.]+" means any.
std::string channel_pattern(std::string_view prefix, std::string_view kind);

}  // namespace strainwave
