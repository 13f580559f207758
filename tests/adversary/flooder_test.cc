// SPDX-License-Identifier: BSD-3-Clause
// The flooder sends ten thousand crafted datagrams a second, including the fragments that crash LCM's library. The daemon must obey and acknowledge
// every stop, and the gateway must survive. In virtual time each stop must take less than 50 ms.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>
#include <vector>

#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"
#include "tests/adversary/port_sender.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/lcm_datagrams.h"
#include "tests/system/hostile_datagrams.h"

namespace strainwave::testing {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kPer_ms = 10;
constexpr int kStops = 15;
constexpr double kBound_ms = 50.0;

/// Floods the group from several ports until it is killed. The crashing fragments go to a channel of orders, because LCM's library only reads
/// fragments of subscribed channels. A subscriber with that library would crash.
[[noreturn]] void flood(std::uint64_t seed) {
  std::array<PortSender, 8> ports;
  HostileDatagrams datagrams(seed);
  std::uint32_t sequence = 0;
  auto due = Clock::now();
  for (std::size_t turn = 0;; ++turn) {
    const PortSender& port = ports[turn % ports.size()];
    for (const Bytes& datagram : crashing_fragments("SW.elbow.COMMAND", ++sequence)) port.send(datagram);
    for (int i = 2; i < kPer_ms; ++i) port.send(datagrams.next());
    due += milliseconds(1);
    std::this_thread::sleep_until(due);
  }
}

/// Floods with valid orders that cost the core most: ten thousand tables a second to certify. They come from as many ports as the gateway can keep
/// orders of, so that no other order finds a place.
[[noreturn]] void flood_with_tables(gain_table_v1 table) {
  TestClient listener;
  std::vector<PortSender> ports(256);
  table.sequence += 1'000'000'000;  // keeps the answers to these tables apart from the answer to a stop
  auto due = Clock::now();
  for (;;) {
    listener.pump(milliseconds(0));
    const auto& state = listener.state("elbow");
    for (int i = 0; i < kPer_ms && state; ++i) {
      table.challenge = state->challenge;
      ++table.sequence;
      const auto port = static_cast<std::size_t>(table.sequence) % ports.size();
      ports[port].send(short_datagram("SW.elbow.TABLE", encode(table)));
    }
    due += milliseconds(1);
    std::this_thread::sleep_until(due);
  }
}

class Flooder {
 public:
  explicit Flooder(std::uint64_t seed) : pid_(::fork()) {
    if (pid_ == 0) flood(seed);
  }
  explicit Flooder(const gain_table_v1& table) : pid_(::fork()) {
    if (pid_ == 0) flood_with_tables(table);
  }
  ~Flooder() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Flooder(const Flooder&) = delete;
  Flooder& operator=(const Flooder&) = delete;

 private:
  pid_t pid_;
};

class FlooderTest : public DaemonTest {
 protected:
  void SetUp() override {
    daemon_.emplace(folder_, configuration());
    ASSERT_TRUE(client_.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(client_.load("elbow", shipped_table()).accepted);
    gateway_ = daemon_->gateway_pid();
  }
  /// Repeats the order until the joint holds: orders may get lost, stops may not.
  bool hold_position() {
    for (int i = 0; i < 50; ++i) {
      client_.lcm().publish("SW.elbow.COMMAND", &enable());
      if (client_.wait_for_mode("elbow", Mode::kHolding, milliseconds(200))) return true;
    }
    return false;
  }
  struct Stop {
    double obeyed_ms = 0.0;  ///< time until the first state that shows the stop, by the daemon's clock
    double known_ms = 0.0;   ///< time until this flooded client has seen the acknowledgement
  };
  Stop stop() {
    const command_v1 stop = client_.make_command("elbow", Action::kDisable);
    client_.forget_states();
    const auto sent = Clock::now();
    const auto sent_us = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::system_clock::now().time_since_epoch());
    // Repeats the stop until it is answered, as clients do. The flood reaches this receiver too, and an acknowledgement may get lost.
    Answer answer;
    for (int i = 0; i < 25 && !answer.accepted; ++i) {
      client_.lcm().publish("SW.elbow.COMMAND", &stop);
      answer = client_.wait_for_answer(stop.sequence, milliseconds(200));
    }
    EXPECT_TRUE(answer.accepted) << answer.text;
    EXPECT_TRUE(client_.wait_for_mode("elbow", Mode::kOff, seconds(5)));
    Stop result;
    result.known_ms = std::chrono::duration<double, std::milli>(Clock::now() - sent).count();
    for (const state_v1& state : client_.history("elbow")) {
      if (state.mode != static_cast<std::int32_t>(Mode::kOff)) continue;
      result.obeyed_ms = 1e-3 * static_cast<double>(state.utime - sent_us.count());
      break;
    }
    return result;
  }

  std::optional<DaemonProcess> daemon_;
  TestClient client_;
  pid_t gateway_ = -1;

 private:
  const command_v1& enable() {
    enable_ = client_.make_command("elbow", Action::kEnable);
    return enable_;
  }
  command_v1 enable_{};
};

TEST_F(FlooderTest, EveryStopIsObeyedAndAcknowledgedAndTheGatewayLives) {
  const Flooder flooder(20261121);
  client_.pump(milliseconds(200));
  double longest_ms = 0.0;
  for (int i = 0; i < kStops; ++i) {
    ASSERT_TRUE(hold_position()) << i << daemon_->log();
    longest_ms = std::max(longest_ms, stop().known_ms);
    ASSERT_FALSE(HasFailure()) << "stop " << i;
  }
  std::printf("%d stops, the longest took %.2f ms\n", kStops, longest_ms);
  if (in_virtual_time()) {
    EXPECT_LT(longest_ms, kBound_ms);
  }
  EXPECT_EQ(daemon_->gateway_pid(), gateway_) << daemon_->log();
  EXPECT_EQ(daemon_->log().find("the gateway ended"), std::string::npos);
  EXPECT_NE(daemon_->log().find("malformed datagrams"), std::string::npos) << "the flood did not come in";
}

// Stops have a lane of their own. The queue of orders is full, and each order costs the core milliseconds.
TEST_F(FlooderTest, StopsGoBeforeOrdersForWhichThereIsNoRoom) {
  Stop longest;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(hold_position()) << i << daemon_->log();
    gain_table_v1 table = client_.make_table("elbow", shipped_table());
    const Flooder flooder(table);
    client_.pump(seconds(1));
    const Stop one = stop();
    longest.obeyed_ms = std::max(longest.obeyed_ms, one.obeyed_ms);
    longest.known_ms = std::max(longest.known_ms, one.known_ms);
    ASSERT_FALSE(HasFailure()) << "stop " << i;
  }
  std::printf("the longest took %.2f ms, known after %.2f ms\n", longest.obeyed_ms, longest.known_ms);
  if (in_virtual_time()) {
    EXPECT_LT(longest.obeyed_ms, kBound_ms);
  }
}

TEST_F(FlooderTest, TheDaemonEndsInOrderWhenItIsToldTo) {
  const Flooder flooder(20261122);
  ASSERT_TRUE(hold_position()) << daemon_->log();
  const auto told = Clock::now();
  daemon_->signal(SIGTERM);
  EXPECT_EQ(daemon_->wait_for_end(seconds(20)), 0) << daemon_->log();
  std::printf("ended after %.1f ms\n",
              std::chrono::duration<double, std::milli>(Clock::now() - told).count());
}

}  // namespace
}  // namespace strainwave::testing
