// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/topic_news.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace strainwave {
namespace {

using Json = nlohmann::json;

TEST(TopicNews, TellOfEveryTopicOnceAFewAtATime) {
  Topics topics;
  TopicNews news;
  constexpr std::size_t kTopics = 3 * TopicNews::kAtOnce + 1;
  for (std::size_t i = 0; i < kTopics; ++i)
    news.offer(topics.add("SW.j" + std::to_string(i) + ".STATE", "s", "{}", 0.0)->id);
  std::set<std::string> told;
  int messages = 0;
  while (const auto text = news.pop(topics)) {
    const Json message = Json::parse(*text);
    EXPECT_EQ(message.at("op"), "advertise");
    EXPECT_LE(message.at("channels").size(), TopicNews::kAtOnce);
    for (const Json& channel : message.at("channels")) EXPECT_TRUE(told.insert(channel.at("topic")).second);
    ++messages;
  }
  EXPECT_EQ(told.size(), kTopics);
  EXPECT_EQ(messages, 4);
}

TEST(TopicNews, SayNothingOfWhatCameAndWentAndWithdrawWhatWasTold) {
  Topics topics;
  TopicNews news;
  const std::uint32_t told = topics.add("SW.a.STATE", "s", "{}", 0.0)->id;
  news.offer(told);
  ASSERT_TRUE(news.pop(topics));
  news.offer(77);
  news.withdraw(77);
  EXPECT_FALSE(news.pop(topics));
  news.withdraw(told);
  EXPECT_EQ(Json::parse(news.pop(topics).value()),
            (Json{{"op", "unadvertise"}, {"channelIds", Json::array({told})}}));
  EXPECT_FALSE(news.pop(topics));
}

TEST(TopicNews, OfAHundredThousandNamesAreNoMoreThanThereAreTopics) {
  TopicNews news;
  constexpr auto kMax = static_cast<std::uint32_t>(Topics::kMax);
  for (std::uint32_t id = 1; id < 100000; ++id) {
    news.offer(id);
    if (id > kMax) news.withdraw(id - kMax);
    ASSERT_LE(news.size(), kMax);
  }
}

}  // namespace
}  // namespace strainwave
