// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/message_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "lcmtypes/message_kinds.h"

namespace strainwave {
namespace {

using Json = nlohmann::json;

template <typename Message>
void expect_keys_of_schema() {
  const Json schema = Json::parse(message_schema<Message>());
  const Json value = Json::parse(message_json(Message{}));
  EXPECT_EQ(schema["title"], schema_name<Message>());
  for (const auto& [key, entry] : value.items()) EXPECT_TRUE(schema["properties"].contains(key)) << key;
  EXPECT_EQ(value.size(), schema["properties"].size());
}

/// Foxglove's parseJsonSchema requires one word as the type of a field. Otherwise it shows nothing of the topic.
template <typename Message>
void expect_types_that_viewers_know() {
  const Json schema = Json::parse(message_schema<Message>());
  for (const auto& [key, entry] : schema["properties"].items()) {
    const Json& type = entry["type"] == "array" ? entry["items"]["type"] : entry["type"];
    EXPECT_TRUE(type == "number" || type == "integer" || type == "string") << key << ": " << type;
  }
}

TEST(MessageJson, HasOneTypeForEachFieldThoughANumberMayBeNull) {
  expect_types_that_viewers_know<state_v1>();
  expect_types_that_viewers_know<temperature_v1>();
  expect_types_that_viewers_know<limits_v1>();
  expect_types_that_viewers_know<timing_v1>();
  expect_types_that_viewers_know<ack_v1>();
}

TEST(MessageJson, HasTheKeysOfItsSchema) {
  expect_keys_of_schema<state_v1>();
  expect_keys_of_schema<temperature_v1>();
  expect_keys_of_schema<limits_v1>();
  expect_keys_of_schema<timing_v1>();
  expect_keys_of_schema<setpoint_v1>();
  expect_keys_of_schema<command_v1>();
  expect_keys_of_schema<inject_v1>();
  expect_keys_of_schema<ack_v1>();
}

TEST(MessageJson, KeepsWhatAReaderInJavaScriptWouldRound) {
  state_v1 state{};
  state.session_id = state.challenge = std::numeric_limits<std::int64_t>::max();
  state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  state.rule_count = 3;
  const Json value = Json::parse(message_json(state));
  EXPECT_EQ(value["session_id"], "9223372036854775807");
  EXPECT_EQ(value["challenge"], "9223372036854775807");
  EXPECT_TRUE(value["temperature_used_C"].is_null());
  EXPECT_EQ(value["temperature_weights"].size(), 3U);
  EXPECT_EQ(value["mode_text"], "off");
}

TEST(MessageJson, HasTheDistanceFromSetpointToPosition) {
  state_v1 state{};
  state.setpoint_position_rad = 1.0;
  state.setpoint_velocity_rad_s = 2.0;
  state.joint_position_rad = 0.9;
  const Json value = Json::parse(message_json(state));
  EXPECT_DOUBLE_EQ(value["tracking_error_rad"].get<double>(), 1.0 - 0.9);
}

TEST(MessageKinds, KnowATypeForEachKindAndRefuseTheBytesOfAnother) {
  std::string visited;
  const auto visit = [&](const auto& message) { visited = message.getTypeName(); };
  EXPECT_TRUE(visit_message("STATE", encode(state_v1{}), visit));
  EXPECT_EQ(visited, "state_v1");
  EXPECT_TRUE(visit_message("ACK", encode(ack_v1{}), visit));
  EXPECT_EQ(visited, "ack_v1");
  visited.clear();
  EXPECT_FALSE(visit_message("STATE", encode(ack_v1{}), visit));
  EXPECT_FALSE(visit_message("TABLE", encode(state_v1{}), visit));
  EXPECT_FALSE(visit_message("STATE", {}, visit));
  EXPECT_EQ(visited, "");
}

}  // namespace
}  // namespace strainwave
