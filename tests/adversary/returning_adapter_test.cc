// SPDX-License-Identifier: BSD-3-Clause
// A network adapter that disappears and returns with the same name and address, as a USB adapter does, and one that is missing at start. The tests
// use the real daemon and our own programs in a separate network.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <strainwave/command_v1.hpp>
#include <string>

#include "client/protocol/client.h"
#include "strainwave/client_error.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {
namespace {

bool run(const std::string& commands) {
  const std::string path = "PATH=$PATH:/usr/sbin:/sbin; set -e; ";
  return std::system((path + commands).c_str()) ==
         0;  // NOLINT(concurrency-mt-unsafe): the threads here set nothing
}

bool make_adapter() {
  return run(
      "ip link add lan0 type veth peer name lan1; ip address add 192.168.7.1/24 dev lan0; ip link set lan1 "
      "up; "
      "ip link set lan0 up multicast on; "
      "ip route add 239.255.76.67/32 dev lan0");
}

bool take_adapter_away() {
  return run("ip link delete lan0");
}

class ReturningAdapter : public DaemonTest {
 protected:
  static void SetUpTestSuite() {
    if (!enter_private_network(false)) GTEST_SKIP() << "this system allows no network of a test's own";
  }
  void TearDown() override { (void)run("ip link delete lan0 2>/dev/null || true"); }

  static bool hears_states(Client& client) {
    const std::int64_t before = client.find("elbow") == nullptr ? 0 : client.find("elbow")->messages;
    return client.wait_until(
        [&] { return client.find("elbow") != nullptr && client.find("elbow")->messages > before + 10; },
        Deadline(kPatience_s));
  }
  static bool stops(Client& client) {
    command_v1 hold{};
    hold.action = static_cast<std::int32_t>(Action::kDisable);
    try {
      return client.request_unseen("elbow", "COMMAND", hold).accepted;
    } catch (const NoAnswer& error) {
      ADD_FAILURE() << error.what();
      return false;
    }
  }

  static constexpr double kPatience_s = 10.0;  // allows for a busy host
};

TEST_F(ReturningAdapter, IsJoinedAnewByTheDaemonAndByWhoeverListens) {
  ASSERT_TRUE(make_adapter());
  DaemonProcess daemon(folder_, configuration());
  ASSERT_TRUE(daemon.wait_for_log("ready after", std::chrono::seconds(20))) << daemon.log();
  Connection connection(kTestUrl);
  Connection recorder(kTestUrl);
  recorder.read_ahead();
  Client client(connection, {"SW", kPatience_s});
  Client recording(recorder, {"SW", kPatience_s});
  ASSERT_TRUE(hears_states(client)) << daemon.log();
  ASSERT_TRUE(hears_states(recording));
  for (int time = 0; time < 2; ++time) {
    ASSERT_TRUE(take_adapter_away());
    ASSERT_TRUE(make_adapter());
    EXPECT_TRUE(hears_states(client)) << daemon.log();
    EXPECT_TRUE(hears_states(recording));
    EXPECT_TRUE(stops(client)) << daemon.log();
  }
  EXPECT_NE(daemon.log().find("the gateway does not receive its own messages"), std::string::npos)
      << daemon.log();
  EXPECT_EQ(daemon.log().find("signal "), std::string::npos) << "the filter of system calls ended a gateway\n"
                                                             << daemon.log();
  EXPECT_TRUE(daemon.running());
}

TEST_F(ReturningAdapter, IsWaitedForAtStart) {
  DaemonProcess daemon(folder_, configuration());
  ASSERT_TRUE(daemon.wait_for_log("waiting for LCM on", std::chrono::seconds(20))) << daemon.log();
  EXPECT_EQ(daemon.wait_for_end(std::chrono::seconds(6)), -1) << daemon.log();
  ASSERT_TRUE(make_adapter());
  ASSERT_TRUE(daemon.wait_for_log("ready after", std::chrono::seconds(20))) << daemon.log();
  Connection connection(kTestUrl);
  Client client(connection, {"SW", kPatience_s});
  EXPECT_TRUE(hears_states(client)) << daemon.log();
  EXPECT_TRUE(stops(client)) << daemon.log();
}

TEST_F(ReturningAdapter, IsNotWaitedForByADaemonThatIsToEnd) {
  DaemonProcess daemon(folder_, configuration());
  ASSERT_TRUE(daemon.wait_for_log("waiting for LCM on", std::chrono::seconds(20))) << daemon.log();
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_end(std::chrono::seconds(10)), 0) << daemon.log();
}

}  // namespace
}  // namespace strainwave::testing
