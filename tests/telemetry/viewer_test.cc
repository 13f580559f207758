// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/viewer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace strainwave {
namespace {

using Json = nlohmann::json;

class ViewerTest : public ::testing::Test {
 protected:
  ViewerTest()
      : elbow_(topics_.add("SW.elbow.STATE", "strainwave.state_v1", R"({"type":"object"})", 0.0)->id),
        timing_(topics_.add("SW.TIMING", "strainwave.timing_v1", "{}", 0.0)->id) {}

  /// Returns the message of the answer, or "" without an answer.
  std::string answer(const std::string& text) {
    const auto answer = viewer_.take(text, topics_, 0.0);
    if (!answer) return "";
    const Json json = Json::parse(*answer);
    EXPECT_EQ(json["op"], "status");
    EXPECT_EQ(json["level"], 2);
    return json["message"];
  }
  static std::string subscribe(std::uint32_t id, std::uint32_t topic) {
    return Json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", topic}}}}}.dump();
  }

  Topics topics_;
  std::uint32_t elbow_;
  std::uint32_t timing_;
  Viewer viewer_;
};

TEST_F(ViewerTest, WantsWhatItSubscribedToUnderItsOwnNumberUntilItUnsubscribes) {
  EXPECT_FALSE(viewer_.subscription(elbow_));
  EXPECT_EQ(answer(subscribe(77, elbow_)), "");
  EXPECT_EQ(viewer_.subscription(elbow_), 77U);
  EXPECT_FALSE(viewer_.subscription(timing_));
  EXPECT_EQ(answer(R"({"op":"unsubscribe","subscriptionIds":[77]})"), "");
  EXPECT_FALSE(viewer_.subscription(elbow_));
}

TEST_F(ViewerTest, HasOneSubscriptionForATopicHoweverOftenItAsks) {
  EXPECT_EQ(answer(subscribe(1, elbow_)), "");
  for (std::uint32_t id = 2; id < 1000; ++id) EXPECT_NE(answer(subscribe(id, elbow_)), "");
  EXPECT_NE(answer(subscribe(1, timing_)), "") << "a number that is in use";
  EXPECT_EQ(viewer_.subscriptions(), 1U);
}

TEST_F(ViewerTest, IsToldWhatIsWrongWithWhatMakesNoSense) {
  for (const char* text :
       {"", "{", "[]", "null", "7", "\"op\"", "{}", R"({"op":7})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967297}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})", R"({"op":"unsubscribe","subscriptionIds":[5]})",
        R"({"op":"advertise","channels":[]})", R"({"op":"setParameters"})", "\xff\xfe"})
    EXPECT_NE(answer(text), "") << text;
  EXPECT_EQ(viewer_.subscriptions(), 0U);
}

TEST_F(ViewerTest, SurvivesDepth) {
  const std::string deep(Viewer::kLongestMessage, '[');
  EXPECT_NE(answer(deep), "");
  EXPECT_NE(answer(std::string(30000, '[') + std::string(30000, ']')), "");
}

TEST_F(ViewerTest, GetsItsOwnWordsBackWithoutWhatCommandsATerminal) {
  const std::string said = answer(R"({"op":"\u001b[2J)" + std::string(1000, 'x') + "\"}");
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
  EXPECT_LT(said.size(), 200U);
}

TEST_F(ViewerTest, ForgetsATopicThatIsGone) {
  answer(subscribe(1, elbow_));
  viewer_.forget(elbow_);
  EXPECT_FALSE(viewer_.subscription(elbow_));
  EXPECT_EQ(answer(subscribe(1, timing_)), "") << "the number is free again";
}

TEST_F(ViewerTest, IsOfferedEveryTopicWithItsSchema) {
  const std::vector<const Topic*> known{&topics_.at(elbow_), &topics_.at(timing_)};
  const Json all = Json::parse(advertise(known));
  EXPECT_EQ(all["op"], "advertise");
  ASSERT_EQ(all["channels"].size(), 2U);
  for (const Json& channel : all["channels"]) {
    EXPECT_EQ(channel["encoding"], "json");
    EXPECT_EQ(channel["schemaEncoding"], "jsonschema");
    EXPECT_TRUE(Json::accept(channel["schema"].get<std::string>()));
  }
}

TEST(MessageHead, IsOpcodeSubscriptionAndTimeInLittleEndian) {
  const MessageHead head = message_head(0x04030201, 0x0f0e0d0c0b0a0908);
  EXPECT_EQ(head, (MessageHead{1, 1, 2, 3, 4, 8, 9, 0x0a, 0x0b, 0x0c, 0x0d, 0x0e, 0x0f}));
}

TEST(Subprotocol, IsTheNewestOfThoseOffered) {
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("x ,\tfoxglove.websocket.v1 "), "foxglove.websocket.v1");
  EXPECT_FALSE(choose_subprotocol(""));
  EXPECT_FALSE(choose_subprotocol(",,"));
  EXPECT_FALSE(choose_subprotocol("foxglove.websocket.v12"));
}

}  // namespace
}  // namespace strainwave
