// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/page_order.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

using Json = nlohmann::json;

std::string words_in(const Json& json) {
  return json.is_string() ? json.get<std::string>() : "";
}

std::optional<double> real_in(const Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

/// An integer within the range that JavaScript represents exactly.
std::optional<std::int64_t> whole_in(const Json& json) {
  constexpr double kLargest = 9007199254740991.0;
  const auto value = real_in(json);
  return value && std::abs(*value) <= kLargest ? std::optional(static_cast<std::int64_t>(*value))
                                               : std::nullopt;
}

std::optional<std::int64_t> digits_in(const Json& json) {
  const std::string digits = words_in(json);
  std::int64_t value = 0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool all = error == std::errc() && last == digits.data() + digits.size();
  return all ? std::optional(value) : std::nullopt;
}

std::optional<OpenOrders::Name> joint_in(const Json& json) {
  const auto parts = parse_channel(words_in(json) + "." + std::string(channel_kind::kCommand));
  return parts ? std::optional(OpenOrders::Name{parts->prefix, parts->joint}) : std::nullopt;
}

}  // namespace

PageOrder read_page_order(const Json& json) {
  const auto field = [&](const char* key) {
    const auto found = json.find(key);
    return found == json.end() ? Json() : *found;
  };
  PageOrder order;
  order.action = words_in(field("action"));
  order.token = words_in(field("token"));
  order.joint = joint_in(field("joint"));
  const auto session_id = digits_in(field("session_id"));
  const auto challenge = digits_in(field("challenge"));
  if (session_id && challenge) order.quote = Quote{*session_id, *challenge};
  order.jog = whole_in(field("jog"));
  order.velocity_rad_s = real_in(field("velocity_rad_s"));
  return order;
}

}  // namespace strainwave
