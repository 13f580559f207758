// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/viewer.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/printable.h"

namespace strainwave {

namespace {

using Json = nlohmann::json;

// In order of preference.
constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};
/// Number of characters of a viewer's text that an answer repeats.
constexpr std::size_t kQuoted = 40;

Json as_json(const Topic& topic) {
  return {{"id", topic.id},
          {"topic", topic.name},
          {"encoding", "json"},
          {"schemaName", topic.schema_name},
          {"schemaEncoding", "jsonschema"},
          {"schema", topic.schema}};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns the "op" of a message, or an empty text. The rest of `message` is still unchecked.
std::string operation_of(const Json& message) {
  if (!message.is_object()) return "";
  const auto op = message.find("op");
  return op != message.end() && op->is_string() ? op->get<std::string>() : "";
}

std::optional<std::uint32_t> number(const Json& json) {
  if (!json.is_number_integer() && !json.is_number_unsigned()) return std::nullopt;
  const auto value = json.is_number_unsigned()
                         ? json.get<std::uint64_t>()
                         : static_cast<std::uint64_t>(json.get<std::int64_t>());  // below 0: too large
  if (value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

std::optional<std::uint32_t> number(const Json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : number(*found);
}

const Json* array(const Json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() && found->is_array() ? &*found : nullptr;
}

std::string refusal(const std::string& why) {
  return status(StatusLevel::kError, why, "refused");
}

}  // namespace

std::optional<std::string_view> choose_subprotocol(std::string_view offered) {
  for (const std::string_view known : kSubprotocols) {
    std::string_view rest = offered;
    while (!rest.empty()) {
      std::string_view word = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), word.size() + 1));
      while (word.starts_with(' ') || word.starts_with('\t')) word.remove_prefix(1);
      while (word.ends_with(' ') || word.ends_with('\t')) word.remove_suffix(1);
      if (word == known) return known;
    }
  }
  return std::nullopt;
}

std::string server_info(const std::string& session, bool acting) {
  const Json metadata = acting ? Json{{"acting", "on"}} : Json::object();
  return text_of({{"op", "serverInfo"},
                  {"name", "strainwave-telemetry " STRAINWAVE_VERSION},
                  {"capabilities", Json::array()},
                  {"metadata", metadata},
                  {"sessionId", session}});
}

std::string advertise(std::span<const Topic* const> topics) {
  Json channels = Json::array();
  for (const Topic* topic : topics) channels.push_back(as_json(*topic));
  return text_of({{"op", "advertise"}, {"channels", channels}});
}

std::string unadvertise(std::span<const std::uint32_t> topics) {
  return text_of(
      {{"op", "unadvertise"}, {"channelIds", std::vector<std::uint32_t>(topics.begin(), topics.end())}});
}

std::string status(StatusLevel level, const std::string& message, const std::string& id) {
  return text_of({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}, {"id", id}});
}

MessageHead message_head(std::uint32_t subscription, std::uint64_t received_ns) {
  constexpr std::uint8_t kMessageData = 1;
  MessageHead head{kMessageData};
  for (std::size_t i = 0; i < 4; ++i) head[1 + i] = static_cast<std::uint8_t>(subscription >> (8U * i));
  for (std::size_t i = 0; i < 8; ++i) head[5 + i] = static_cast<std::uint8_t>(received_ns >> (8U * i));
  return head;
}

Viewer::~Viewer() {
  if (acting_ != nullptr) acting_->forget(page_.number);
}

std::optional<std::string> Viewer::take(std::string_view text, const Topics& topics, double now_s) {
  const Json message = Json::parse(text, nullptr, false);
  const std::string operation = operation_of(message);
  std::string problem;
  if (operation == "subscribe") {
    const Json* list = array(message, "subscriptions");
    if (list == nullptr) return refusal("subscribe needs an array 'subscriptions'");
    for (const Json& entry : *list) {
      const auto id = number(entry, "id");
      const auto topic = number(entry, "channelId");
      std::string defect = id && topic ? subscribe(*id, *topic, topics)
                                       : "a subscription needs the numbers 'id' and 'channelId'";
      if (problem.empty()) problem = std::move(defect);
    }
  } else if (operation == "unsubscribe") {
    const Json* list = array(message, "subscriptionIds");
    if (list == nullptr) return refusal("unsubscribe needs an array 'subscriptionIds'");
    for (const Json& entry : *list) {
      const auto id = number(entry);
      std::string defect = id ? unsubscribe(*id) : "a subscription must be a number";
      if (problem.empty()) problem = std::move(defect);
    }
  } else if (operation == "act" && acting_ != nullptr) {
    acting_->take(page_, read_page_order(message), now_s);
  } else {
    problem = operation.empty() ? "a message must be a JSON object with an 'op'"
                                : "'" + printable(operation.substr(0, kQuoted)) +
                                      "' is not supported: subscribe and unsubscribe are";
  }
  return problem.empty() ? std::nullopt : std::optional(refusal(problem));
}

std::optional<std::uint32_t> Viewer::subscription(std::uint32_t topic) const {
  const auto found = by_topic_.find(topic);
  return found == by_topic_.end() ? std::nullopt : std::optional(found->second);
}

void Viewer::forget(std::uint32_t topic) {
  const auto found = by_topic_.find(topic);
  if (found == by_topic_.end()) return;
  topic_of_.erase(found->second);
  by_topic_.erase(found);
}

// A topic has at most one subscription, which bounds the number of subscriptions.
std::string Viewer::subscribe(std::uint32_t id, std::uint32_t topic, const Topics& topics) {
  if (!topics.has(topic)) return fmt::format("there is no channel {}", topic);
  if (topic_of_.contains(id)) return fmt::format("subscription {} is in use", id);
  if (by_topic_.contains(topic)) return fmt::format("channel {} is subscribed to already", topic);
  by_topic_.emplace(topic, id);
  topic_of_.emplace(id, topic);
  return "";
}

std::string Viewer::unsubscribe(std::uint32_t id) {
  const auto found = topic_of_.find(id);
  if (found == topic_of_.end()) return fmt::format("there is no subscription {}", id);
  by_topic_.erase(found->second);
  topic_of_.erase(found);
  return "";
}

}  // namespace strainwave
