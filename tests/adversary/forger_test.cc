// SPDX-License-Identifier: BSD-3-Clause
// An attacker without a key who sends forged orders at a high rate.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/adversary/port_sender.h"
#include "tests/adversary/signed_daemon.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {
namespace {

/// Sends messages in the name of the joint's own user, each with the newest challenge and another wrong signature. It sends five thousand a second
/// from eight ports. Any listener on the network can do this.
class Forger {
 public:
  /// Forges `message` on <channel>, as if `key` had signed it.
  template <typename Message>
  Forger(const std::string& kind, Message message, const SecretKey& key) : pid_(::fork()) {
    if (pid_ != 0) return;
    TestClient listener;
    std::array<PortSender, 8> ports;
    const std::string channel = "SW.elbow." + kind;
    std::vector<std::uint8_t> bytes;
    std::size_t tries = 0;
    auto due = std::chrono::steady_clock::now();
    for (;;) {
      listener.pump(std::chrono::milliseconds(0));
      if (const auto& state = listener.state("elbow"); state && state->challenge != message.challenge) {
        message.challenge = state->challenge;
        bytes = encode(message);
        sign(channel, key, bytes);
      }
      for (int i = 0; i < kPer_ms && !bytes.empty(); ++i, ++tries) {
        ++bytes[bytes.size() - 1 - tries % sizeof(Signature)];
        ports[tries % ports.size()].send(short_datagram(channel, bytes));
      }
      std::this_thread::sleep_until(due += std::chrono::milliseconds(1));
    }
  }
  ~Forger() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Forger(const Forger&) = delete;
  Forger& operator=(const Forger&) = delete;

 private:
  static constexpr int kPer_ms = 5;
  pid_t pid_;
};

class ForgerTest : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("");
    client_.emplace();
    bring_to_hold(*client_);
  }
  /// Despite the forgeries, the daemon must obey and acknowledge each stop, with and without a signature. Each stop comes from a new sender, so that
  /// no stop profits from earlier traffic.
  void expect_stops(bool with_signature) {
    constexpr int kStops = 25;  // enough that luck cannot answer them all
    for (int i = 0; i < kStops; ++i) {
      const command_v1 stop = client_->make_command("elbow", Action::kDisable);
      std::vector<std::uint8_t> bytes = encode(stop);
      if (with_signature) sign("SW.elbow.COMMAND", key_, bytes);
      PortSender().send(short_datagram("SW.elbow.COMMAND", bytes));
      const Answer answer = client_->wait_for_answer(stop.sequence);
      ASSERT_TRUE(answer.accepted) << i << ": " << answer.text;
      EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kOff)) << i;
    }
  }
  std::optional<TestClient> client_;
};

TEST_F(ForgerTest, OfMovesKeepsNoAnswerToAStopBack) {
  const Forger forger("SETPOINT", client_->make_setpoint("elbow", 1.0), key_);
  client_->pump(std::chrono::seconds(1));
  EXPECT_NEAR(client_->state("elbow")->joint_position_rad, 0.0, 1e-2);
  expect_stops(true);
  expect_stops(false);
}

TEST_F(ForgerTest, OfMovesKeepsNoMoveBack) {
  const Forger forger("SETPOINT", client_->make_setpoint("elbow", 1.0), key_);
  client_->pump(std::chrono::seconds(1));
  for (int i = 0; i < 25; ++i) {
    const Answer answer = send(*client_, "SETPOINT", client_->make_setpoint("elbow", 0.01 * (i % 2)));
    ASSERT_TRUE(answer.accepted) << i << ": " << answer.text;
  }
}

TEST_F(ForgerTest, OfStopsKeepsNoAnswerToAStopBack) {
  const Forger forger("COMMAND", client_->make_command("elbow", Action::kDisable), key_);
  client_->pump(std::chrono::seconds(1));
  ASSERT_EQ(client_->state("elbow")->mode, static_cast<std::int32_t>(Mode::kOff))
      << "the forger was not heard";
  expect_stops(true);
  expect_stops(false);
}

}  // namespace
}  // namespace strainwave::testing
