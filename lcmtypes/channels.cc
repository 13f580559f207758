// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/channels.h"

#include <algorithm>

namespace strainwave {

namespace {
constexpr std::size_t kMaxNameLength = 24;
constexpr std::string_view kNameCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
}  // namespace

bool is_valid_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxNameLength && name.front() != '-' &&
         name.find_first_not_of(kNameCharacters) == std::string_view::npos;
}

std::string channel(std::string_view prefix, std::string_view joint, std::string_view kind) {
  std::string name(prefix);
  name.append(".").append(joint).append(".").append(kind);
  return name;
}

std::string timing_channel(std::string_view prefix) {
  return std::string(prefix).append(".").append(channel_kind::kTiming);
}

std::optional<ChannelName> parse_channel(std::string_view name) {
  if (name.size() > kMaxChannelLength) return std::nullopt;
  const std::size_t first = name.find('.');
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = name.find('.', first + 1);
  ChannelName parts{std::string(name.substr(0, first)), "", ""};
  if (!is_valid_name(parts.prefix)) return std::nullopt;
  if (second == std::string_view::npos) {
    parts.kind = name.substr(first + 1);
    return parts.kind == channel_kind::kTiming ? std::optional(parts) : std::nullopt;
  }
  parts.joint = name.substr(first + 1, second - first - 1);
  parts.kind = name.substr(second + 1);
  if (!is_valid_name(parts.joint) || !is_valid_name(parts.kind)) return std::nullopt;
  return parts;
}

std::string channel_pattern(std::string_view prefix, std::string_view kind) {
  std::string pattern(prefix);
  pattern.append("\\.[^.]+\\.").append(kind);
  return pattern;
}

}  // namespace strainwave
