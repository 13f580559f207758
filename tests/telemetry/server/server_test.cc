// SPDX-License-Identifier: BSD-3-Clause
// What strainwave-telemetry publishes of the messages on LCM.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <thread>

#include "client/protocol/key_file.h"
#include "tests/support/fragment_attack.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_client.h"
#include "tests/telemetry/server/running_telemetry.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

template <typename Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 100; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(50));
  }
  return false;
}

class Server : public ::testing::Test {
 protected:
  lcm::LCM lcm_{kTestUrl};
};

TEST_F(Server, ShowsPrometheusWhatEachPrefixSays) {
  const RunningTelemetry telemetry;
  ASSERT_NE(telemetry.port(), 0);
  state_v1 state{};
  state.mode = 3;
  for (const char* prefix : {"left", "right", "third"}) {
    state.torque_commanded_Nm += 1.5;
    timing_v1 timing{};
    timing.overruns = 7;
    lcm_.publish(std::string(prefix) + ".elbow.STATE", &state);
    lcm_.publish(std::string(prefix) + ".TIMING", &timing);
  }
  EXPECT_TRUE(comes_true([&] {
    return telemetry.metric(R"(strainwave_joint_torque_newton_meters{prefix="third",joint="elbow"})") ==
               4.5 &&
           telemetry.metric(R"(strainwave_joint_torque_newton_meters{prefix="left",joint="elbow"})") == 1.5 &&
           telemetry.metric(R"(strainwave_joint_mode{prefix="right",joint="elbow"})") == 3.0 &&
           telemetry.metric(R"(strainwave_overruns_total{prefix="right"})") == 7.0;
  })) << telemetry.metrics();
}

TEST_F(Server, OffersAViewerWhatIsHeardBeforeAndAfterItConnects) {
  const RunningTelemetry telemetry;
  state_v1 state{};
  lcm_.publish("SW.elbow.STATE", &state);
  ASSERT_TRUE(comes_true([&] { return telemetry.metrics().find("joint=\"elbow\"") != std::string::npos; }));
  const RawClient viewer(telemetry.port());
  ASSERT_TRUE(viewer.become_viewer());
  EXPECT_NE(viewer.read_until("SW.elbow.STATE").find("serverInfo"), std::string::npos);
  lcm_.publish("SW.knee.STATE", &state);
  EXPECT_NE(viewer.read_until("SW.knee.STATE").find("\"op\":\"advertise\""), std::string::npos);
}

TEST_F(Server, OutlivesWhatEndsLcmsLibrary) {
  const RunningTelemetry telemetry;
  {
    const FragmentAttack attack(kTestUrl, {"SW.elbow.STATE", "SW.TIMING"});
    EXPECT_TRUE(comes_true([&] { return attack.rounds() > 200; }));
  }
  const std::vector<std::uint8_t> junk(100, 0xff);
  lcm_.publish("SW.elbow.STATE", junk.data(), static_cast<unsigned int>(junk.size()));
  EXPECT_TRUE(comes_true(
      [&] { return telemetry.metric(R"(strainwave_telemetry_messages_total{kind="other"})") >= 1.0; }));
  EXPECT_TRUE(telemetry.running());
}

TEST_F(Server, BelongsToWhoeverHasTheTokenWhereThereIsOne) {
  const TemporaryFolder folder;
  const std::string token = folder.path() / "token";
  std::ofstream(token) << "0123456789abcdef\n";
  std::filesystem::permissions(token, std::filesystem::perms::owner_read);
  const RunningTelemetry telemetry({"--token-file", token});
  const auto answer = [&](const std::string& request) {
    const RawClient client(telemetry.port());
    client.send(request + "Host: robot\r\n\r\n");
    return client.read_all().substr(0, 12);
  };
  EXPECT_EQ(answer("GET /metrics HTTP/1.1\r\n"), "HTTP/1.1 401");
  EXPECT_EQ(answer("GET /metrics HTTP/1.1\r\nAuthorization: Bearer 0123456789abcdeX\r\n"), "HTTP/1.1 401");
  EXPECT_EQ(answer("GET /metrics HTTP/1.1\r\nAuthorization: Bearer 0123456789abcdef\r\n"), "HTTP/1.1 200");
  EXPECT_EQ(answer("GET /metrics?token=0123456789abcdef HTTP/1.1\r\n"), "HTTP/1.1 200");
}

TEST_F(Server, TellsTheLengthOfThePageToWhoAsksForItsHeadAlone) {
  const RunningTelemetry telemetry;
  const RawClient client(telemetry.port());
  client.send("HEAD /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string answer = client.read_all();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_NE(answer.find("Content-Length: "), std::string::npos) << answer;
  EXPECT_EQ(answer.find("Content-Length: 0"), std::string::npos) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\n")) << "no page behind it\n" << answer;
}

TEST_F(Server, DoesNotListenToOtherMachinesWithoutAToken) {
  const TemporaryFolder folder;
  const std::string token = folder.path() / "token";
  std::ofstream(token) << "0123456789abcdef\n";
  std::filesystem::permissions(token, std::filesystem::perms::owner_read);
  const RunningTelemetry without({}, "0.0.0.0");
  EXPECT_EQ(without.port(), 0);
  const RunningTelemetry with({"--token-file", token}, "0.0.0.0");
  EXPECT_NE(with.port(), 0);
}

TEST_F(Server, IsNotForPagesThatABrowserHappensToVisit) {
  const RunningTelemetry telemetry;
  const auto answer = [&](const std::string& headers) {
    const RawClient client(telemetry.port());
    client.send("GET /metrics HTTP/1.1\r\n" + headers + "\r\n");
    return client.read_all().substr(0, 12);
  };
  EXPECT_EQ(answer("Host: localhost\r\n"), "HTTP/1.1 200");
  EXPECT_EQ(answer("Host: localhost\r\nOrigin: https://evil.example\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(answer("Host: evil.example\r\n"), "HTTP/1.1 403");
}

/// strainwave-telemetry with an operator's key, and its orders to the joint "elbow".
class ActingServer : public Server {
 protected:
  ActingServer() {
    write_new_key(key_, Role::kOperator, "bench");
    lcm_.subscribe("SW.elbow.COMMAND", &ActingServer::on_command, this);
  }
  /// Returns the answer to a stop request of a viewer with these headers.
  std::string stop_by(const RunningTelemetry& telemetry, const std::string& headers) const {
    const RawClient viewer(telemetry.port());
    if (!viewer.become_viewer(headers)) return "no viewer";
    viewer.send_text(R"({"op":"act","action":"stop"})");
    return viewer.read_until("\"acted\",\"refused\"");
  }
  /// Publishes a state of the joint "elbow". Returns whether the server shows it.
  bool show_elbow(const RunningTelemetry& telemetry) {
    const state_v1 state{};
    return comes_true([&] {
      lcm_.publish("SW.elbow.STATE", &state);
      return telemetry.metric(R"(strainwave_joint_mode{prefix="SW",joint="elbow"})") == 0.0;
    });
  }
  void on_command(const lcm::ReceiveBuffer*, const std::string&, const command_v1*) { ++commands_; }
  void hear() {
    while (lcm_.handleTimeout(200) > 0) {
    }
  }
  static std::string own_page(const RunningTelemetry& telemetry) {
    const std::string host = "localhost:" + std::to_string(telemetry.port());
    return "Host: " + host + "\r\nOrigin: http://" + host + "\r\n";
  }

  TemporaryFolder folder_;
  const std::string key_ = folder_.path() / "key";
  int commands_ = 0;
};

TEST_F(ActingServer, TakesOrdersOfItsOwnPageAlone) {
  const RunningTelemetry telemetry({"--key", key_});
  ASSERT_TRUE(show_elbow(telemetry));
  const std::string host = "Host: localhost:" + std::to_string(telemetry.port()) + "\r\n";
  for (const char* origin : {"", "Origin: https://app.foxglove.dev\r\n", "Origin: file://\r\n",
                             "Origin: http://localhost\r\n", "Origin: https://evil.example\r\n"}) {
    const std::string answer = stop_by(telemetry, host + origin);
    EXPECT_TRUE(answer == "no viewer" || answer.find("only the page of this server") != std::string::npos)
        << origin << answer;
  }
  hear();
  EXPECT_EQ(commands_, 0);
  EXPECT_NE(stop_by(telemetry, own_page(telemetry)).find("stop sent to 1 joint"), std::string::npos);
  hear();
  EXPECT_GT(commands_, 0);
}

TEST_F(ActingServer, TakesNoOrderByARequest) {
  const RunningTelemetry telemetry({"--key", key_});
  ASSERT_TRUE(show_elbow(telemetry));
  const std::string body = R"({"op":"act","action":"stop"})";
  for (const std::string& request : {"GET /?op=act&action=stop HTTP/1.1\r\n" + own_page(telemetry) + "\r\n",
                                     "GET /act?action=stop HTTP/1.1\r\n" + own_page(telemetry) + "\r\n",
                                     "POST /act HTTP/1.1\r\n" + own_page(telemetry) + "Content-Length: " +
                                         std::to_string(body.size()) + "\r\n\r\n" + body}) {
    const RawClient client(telemetry.port());
    client.send(request);
    EXPECT_EQ(client.read_all().find("acted"), std::string::npos);
  }
  hear();
  EXPECT_EQ(commands_, 0);
}

TEST_F(ActingServer, AnnouncesOrdersToItsOwnPageAlone) {
  const RunningTelemetry telemetry({"--key", key_});
  const auto announcement = [&](const std::string& headers) {
    const RawClient viewer(telemetry.port());
    return viewer.become_viewer(headers) ? viewer.read_until("sessionId") : "no viewer";
  };
  EXPECT_NE(announcement(own_page(telemetry)).find("acting"), std::string::npos);
  const std::string other = announcement("Host: localhost\r\nOrigin: https://app.foxglove.dev\r\n");
  EXPECT_NE(other.find("sessionId"), std::string::npos);
  EXPECT_EQ(other.find("acting"), std::string::npos);
}

TEST_F(ActingServer, IsNoneWithoutAKey) {
  const RunningTelemetry telemetry;
  const RawClient viewer(telemetry.port());
  ASSERT_TRUE(viewer.become_viewer(own_page(telemetry)));
  viewer.send_text(R"({"op":"act","action":"stop"})");
  EXPECT_NE(viewer.read_until("refused").find("'act' is not supported"), std::string::npos);
  hear();
  EXPECT_EQ(commands_, 0);
}

TEST_F(ActingServer, DoesNotListenToOtherMachines) {
  const std::string token = folder_.path() / "token";
  std::ofstream(token) << "0123456789abcdef\n";
  std::filesystem::permissions(token, std::filesystem::perms::owner_read);
  const RunningTelemetry telemetry({"--token-file", token, "--key", key_}, "0.0.0.0");
  EXPECT_EQ(telemetry.port(), 0);
}

}  // namespace
}  // namespace strainwave::testing
