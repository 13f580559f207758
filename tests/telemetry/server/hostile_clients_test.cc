// SPDX-License-Identifier: BSD-3-Clause
// Clients of strainwave-telemetry may be hostile or slow. The server must keep running, stay small and serve the others.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <thread>

#include "tests/support/private_network.h"
#include "tests/support/test_client.h"
#include "tests/telemetry/server/running_telemetry.h"

namespace strainwave::testing {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;  // the sanitizer keeps freed memory and adds shadow memory
#else
constexpr bool kMemoryIsOurs = true;
#endif

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

/// Publishes large messages on LCM: 4 kB as JSON, thousands of times a second.
class Chatter {
 public:
  Chatter() : thread_([this] { run(); }) {}
  ~Chatter() {
    stop_ = true;
    thread_.join();
  }
  std::uint64_t said() const noexcept { return said_; }

 private:
  void run() {
    lcm::LCM lcm(kTestUrl);
    timing_v1 timing{};
    for (auto& count : timing.wakeup_latency_count) count = 1234567890123;
    for (auto& count : timing.execution_time_count) count = 1234567890123;
    while (!stop_) {
      for (int i = 0; i < 20; ++i, ++said_) lcm.publish("SW.TIMING", &timing);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> said_{0};
  std::thread thread_;
};

/// Returns the server's id of the topic SW.TIMING.
std::uint32_t timing_topic(const RawClient& viewer) {
  const std::string text = viewer.read_until("\"topic\":\"SW.TIMING\"");
  const std::size_t channel = text.rfind("{\"encoding\"");
  const std::size_t id = text.find("\"id\":", channel);
  return id == std::string::npos ? 0 : static_cast<std::uint32_t>(std::stoul(text.substr(id + 5)));
}

std::string subscribe(std::uint32_t topic) {
  return Json{{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", topic}}}}}.dump();
}

// The page of 512 joints takes long to build. Many clients at once would delay all others, so they share one page.
TEST(HostileClient, WhoFetchesTheMetricsWithOthersGetsTheSamePage) {
  const RunningTelemetry telemetry;
  const Chatter chatter;
  int same = 0;
  for (int i = 0; i < 20; ++i) {
    const std::string page = telemetry.metrics();
    std::this_thread::sleep_for(std::chrono::milliseconds(15));  // the message count rises meanwhile
    same += telemetry.metrics() == page ? 1 : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  EXPECT_GT(same, 0) << "each made anew";
  EXPECT_LT(same, 20) << "never made anew";
}

TEST(TelemetryServer, PacksTheMetricsForThoseWhoTakeThemPacked) {
  const RunningTelemetry telemetry;
  const auto answer = [&](const std::string& fields) {
    const RawClient client(telemetry.port());
    client.send("GET /metrics HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    return client.read_all();
  };
  const std::string packed = answer("Accept-Encoding: gzip\r\n");
  const std::string body = packed.substr(packed.find("\r\n\r\n") + 4);
  EXPECT_NE(packed.find("Content-Encoding: gzip\r\n"), std::string::npos) << packed;
  EXPECT_TRUE(body.starts_with("\x1f\x8b")) << "gzip's magic";
  EXPECT_LT(2 * body.size(), telemetry.metrics().size());
  EXPECT_EQ(answer("").find("Content-Encoding"), std::string::npos);
}

TEST(TelemetryStart, WaitsForARouteToTheGroup) {
  if (!enter_private_network()) GTEST_SKIP() << "this system allows no network of a test's own";
  const std::jthread administrator([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    EXPECT_EQ(std::system("PATH=$PATH:/usr/sbin:/sbin; ip link set lo up multicast on; "
                          "ip route add 239.255.76.99/32 dev lo src 127.0.0.1"),
              0);
  });
  const RunningTelemetry telemetry({"--lcm-url", "udpm://239.255.76.99:7667?ttl=0"});
  EXPECT_FALSE(telemetry.metrics().empty());
}

bool make_adapter() {
  return std::system(
             "PATH=$PATH:/usr/sbin:/sbin; set -e; ip link add lan0 type bridge; "
             "ip address add 192.168.7.1/24 dev lan0; ip link set lan0 up multicast on; "
             "ip route add 239.255.76.67/32 dev lan0") == 0;
}

TEST(TelemetryStart, HearsAgainOnceANetworkAdapterIsBack) {
  if (!enter_private_network(false)) GTEST_SKIP() << "this system allows no network of a test's own";
  ASSERT_TRUE(make_adapter());
  const RunningTelemetry telemetry;
  const auto heard = [&] {
    return telemetry.metric("strainwave_telemetry_messages_total{kind=\"strainwave\"}");
  };
  for (int time = 0; time < 3; ++time) {
    const double before = heard();
    for (int i = 0; i < 200 && heard() <= before; ++i) {
      const timing_v1 timing{};
      lcm::LCM(kTestUrl).publish("SW.TIMING", &timing);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_GT(heard(), before) << time;
    ASSERT_EQ(std::system("PATH=$PATH:/usr/sbin:/sbin; ip link delete lan0"), 0);
    ASSERT_TRUE(make_adapter());
  }
}

TEST(HostileClient, WhoReadsNothingLosesMessagesAndCostsNoMemory) {
  const RunningTelemetry telemetry;
  const Chatter chatter;
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 4; ++i) {
    slow.push_back(std::make_unique<RawClient>(telemetry.port(), 4096));
    ASSERT_TRUE(slow.back()->become_viewer());
    const std::uint32_t topic = timing_topic(*slow.back());
    ASSERT_NE(topic, 0U);
    ASSERT_TRUE(slow.back()->send_text(subscribe(topic)));
  }
  const long before_kB = telemetry.memory_kB();
  const auto deadline = Clock::now() + std::chrono::seconds(20);
  while (telemetry.metric("strainwave_telemetry_dropped_messages_total") < 2000.0 && Clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_GE(telemetry.metric("strainwave_telemetry_dropped_messages_total"), 2000.0);
  // Four queues of 2 MiB and the overhead of the allocator.
  if (kMemoryIsOurs) {
    EXPECT_LT(telemetry.memory_kB() - before_kB, 24 * 1024);
  }
}

TEST(HostileClient, SendsHugeFramesAndIsSentAway) {
  const RunningTelemetry telemetry;
  for (const std::uint64_t bytes : {std::uint64_t{70000}, std::uint64_t{1} << 32, std::uint64_t{1} << 62}) {
    const RawClient client(telemetry.port());
    ASSERT_TRUE(client.become_viewer());
    client.send(frame_header(bytes) + std::string(100000, 'x'));
    EXPECT_TRUE(client.is_closed_within(5.0)) << bytes;
  }
  if (kMemoryIsOurs) {
    EXPECT_LT(telemetry.memory_kB(), 100 * 1024);
  }
  EXPECT_FALSE(telemetry.metrics().empty());
}

TEST(HostileClient, SendsJunkAndIsToldSo) {
  const RunningTelemetry telemetry;
  const RawClient client(telemetry.port());
  ASSERT_TRUE(client.become_viewer());
  for (const std::string& junk :
       {std::string("{"), std::string(60000, '['), std::string("\xff\xff"), std::string(),
        std::string("{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":99}]}")}) {
    ASSERT_TRUE(client.send_text(junk));
    if (junk == "\xff\xff") break;  // not UTF-8: the WebSocket protocol ends here
    EXPECT_NE(client.read_until("\"status\"").find("\"level\":2"), std::string::npos) << junk.substr(0, 20);
  }
  EXPECT_TRUE(client.is_closed_within(5.0));
  EXPECT_FALSE(telemetry.metrics().empty());
}

TEST(HostileClient, AsksForAThousandSubscriptionsOfOneTopicAndGetsOne) {
  const RunningTelemetry telemetry;
  const Chatter chatter;
  const RawClient client(telemetry.port());
  ASSERT_TRUE(client.become_viewer());
  const std::uint32_t topic = timing_topic(client);
  Json list = Json::array();
  for (int id = 0; id < 1000; ++id) list.push_back({{"id", id}, {"channelId", topic}});
  ASSERT_TRUE(client.send_text(Json{{"op", "subscribe"}, {"subscriptions", list}}.dump()));
  EXPECT_NE(client.read_until("is subscribed to already").find("is subscribed to already"),
            std::string::npos);
}

TEST(HostileClient, AsksWithoutEverReadingTheAnswersAndIsSentAway) {
  const RunningTelemetry telemetry;
  const RawClient client(telemetry.port(), 4096);
  ASSERT_TRUE(client.become_viewer());
  const std::string question = "{\"op\":\"" + std::string(60, 'x') + "\"}";
  std::string questions;
  for (int i = 0; i < 1000; ++i) questions += frame_header(question.size()) + question;
  int sent = 0;
  while (client.send(questions) && sent < 1000) ++sent;
  EXPECT_LT(sent, 1000) << "a million answers pile up somewhere";
  if (kMemoryIsOurs) {
    EXPECT_LT(telemetry.memory_kB(), 100 * 1024);
  }
  EXPECT_FALSE(telemetry.metrics().empty());
}

TEST(HostileNames, SendNoViewerAwayHoweverManyComeAndGo) {
  const RunningTelemetry telemetry;
  const RawClient viewer(telemetry.port(), 4096);
  ASSERT_TRUE(viewer.become_viewer());
  lcm::LCM lcm(kTestUrl);
  const state_v1 state{};
  constexpr int kNames = 6000;
  for (int i = 0; i < kNames; ++i) {
    lcm.publish("F.j" + std::to_string(i) + ".STATE", &state);
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GT(telemetry.metric(R"(strainwave_telemetry_messages_total{kind="strainwave"})"), kNames / 2);
  EXPECT_EQ(telemetry.metric("strainwave_telemetry_viewers"), 1.0) << "nothing was asked, nothing is owed";
  ASSERT_TRUE(viewer.send_text("{"));
  EXPECT_NE(viewer.read_until("\"status\"").find("\"status\""), std::string::npos);
}

TEST(HostileClient, SendsItsRequestSlowlyAndKeepsNobodyElseOut) {
  const RunningTelemetry telemetry;
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 300; ++i) {
    slow.push_back(std::make_unique<RawClient>(telemetry.port()));
    slow.back()->send("GET /metrics HT");
  }
  EXPECT_FALSE(telemetry.metrics().empty());
  // The server closes the oldest connections. The newest may take ten seconds.
  EXPECT_TRUE(slow.front()->is_closed_within(2.0));
  EXPECT_TRUE(slow.back()->is_closed_within(20.0));
}

TEST(HostileClient, SendsAHeaderWithoutEndAndIsRefused) {
  const RunningTelemetry telemetry;
  const RawClient client(telemetry.port());
  client.send("GET /" + std::string(20000, 'a'));
  EXPECT_TRUE(client.is_closed_within(5.0));
  EXPECT_FALSE(telemetry.metrics().empty());
}

TEST(HostileClient, ComesInCrowdsAndMostAreRefused) {
  const RunningTelemetry telemetry;
  std::vector<std::unique_ptr<RawClient>> crowd;
  int viewers = 0;
  for (int i = 0; i < 100; ++i) {
    crowd.push_back(std::make_unique<RawClient>(telemetry.port()));
    viewers += crowd.back()->become_viewer() ? 1 : 0;
  }
  EXPECT_EQ(viewers, 32);
  EXPECT_EQ(telemetry.metric("strainwave_telemetry_viewers"), 32.0);
  crowd.clear();
  const RawClient later(telemetry.port());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_TRUE(later.become_viewer()) << "those that left made room";
}

}  // namespace
}  // namespace strainwave::testing
