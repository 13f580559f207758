// SPDX-License-Identifier: BSD-3-Clause
// A stranger on the network has no key and uses neither our library nor LCM's. He knows everything that is published, and messages of others may
// reach him alone. These tests run the worst known attacks against the running daemon. The host's timing decides nothing: they judge only which
// orders are obeyed, and in which order.
#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <thread>

#include "tests/adversary/port_sender.h"
#include "tests/adversary/signed_daemon.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

/// command_v1 encoded byte by byte, as docs/messages.md describes it.
struct RawCommand {
  std::int64_t session_id = 0;
  std::int64_t challenge = 0;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  Action action = Action::kHold;
  Bytes key_id = Bytes(8);
  Bytes signature = Bytes(64);

  Bytes bytes() const {
    const Bytes overheard = encode(command_v1{});
    Bytes bytes(overheard.begin(), overheard.begin() + 8);  // the type's fingerprint
    for (const std::int64_t field : {std::int64_t{0}, session_id, challenge, sender_id, sequence})
      put_number(bytes, static_cast<std::uint64_t>(field), 8);
    put_number(bytes, static_cast<std::uint64_t>(action), 4);
    bytes.insert(bytes.end(), key_id.begin(), key_id.end());
    bytes.insert(bytes.end(), signature.begin(), signature.end());
    return bytes;
  }
};

/// The stranger's socket: it sends arbitrary datagrams to LCM's group.
class Stranger {
 public:
  void send(const Bytes& datagram) const { port_.send(datagram); }
  void send(const std::string& channel, const Bytes& message) {
    send(short_datagram(channel, message, ++sequence_));
  }

 private:
  PortSender port_;
  std::uint32_t sequence_ = 0;
};

/// Calls `volley` in its own thread, `per_s` times a second on average, until it goes out of scope.
class Barrage {
 public:
  Barrage(int per_s, std::function<void()> volley)
      : thread_([this, per_s, volley = std::move(volley)] {
          auto due = std::chrono::steady_clock::now();
          for (; !stop_; ++fired_) {
            volley();
            due += std::chrono::microseconds(1'000'000 / per_s);
            std::this_thread::sleep_until(due);
          }
        }) {}
  ~Barrage() {
    stop_ = true;
    thread_.join();
  }
  Barrage(const Barrage&) = delete;
  Barrage& operator=(const Barrage&) = delete;
  std::int64_t fired() const noexcept { return fired_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> fired_{0};
  std::thread thread_;
};

class StrangerTest : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("");
    client_.emplace();
    bring_to_hold(*client_);
  }
  template <typename Message>
  Bytes signed_bytes(const char* kind, const Message& message) {
    Bytes bytes = encode(message);
    sign(std::string("SW.elbow.") + kind, key_, bytes);
    return bytes;
  }
  /// The stranger sends a stop, which needs neither session nor key. It carries the client's sender id, so that the client receives the answer.
  void stranger_stops(Action action) {
    RawCommand stop;
    stop.sender_id = client_->sender_id();
    stop.sequence = ++strange_sequence_;
    stop.action = action;
    stranger_.send("SW.elbow.COMMAND", stop.bytes());
    const Answer answer = client_->wait_for_answer(stop.sequence);
    ASSERT_TRUE(answer.accepted) << answer.text;
  }
  /// An order made of overheard fields, with a key that the daemon knows and a wrong signature.
  RawCommand forged(Action action) {
    RawCommand command;
    command.session_id = client_->state("elbow")->session_id;
    command.challenge = challenge_;
    command.sender_id = 666;
    command.action = action;
    const Bytes overheard = signed_bytes("COMMAND", command_v1{});
    command.key_id.assign(overheard.end() - 72, overheard.end() - 64);
    command.signature.assign(overheard.end() - 64, overheard.end());
    return command;
  }
  /// Receives messages and updates the challenge that the barrage quotes.
  void listen(milliseconds duration) {
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
      client_->pump(milliseconds(5));
      challenge_ = client_->state("elbow")->challenge;
    }
  }
  /// Transmits the same message up to four times, as strainwavectl does.
  Answer insist(const command_v1& message) {
    for (int i = 0; i < 4; ++i) {
      publish(*client_, "COMMAND", message);
      for (int waits = 0; waits < 50; ++waits) {
        listen(milliseconds(10));
        const Answer answer = client_->wait_for_answer(message.sequence, milliseconds(0));
        if (answer.reason != Reason::kTimedOut) return answer;
      }
    }
    return {};
  }
  std::int32_t mode() { return client_->state("elbow")->mode; }

  Stranger stranger_;
  std::optional<TestClient> client_;
  std::int64_t strange_sequence_ = 1'000'000'000;
  std::atomic<std::int64_t> challenge_{0};
};

TEST_F(StrangerTest, CannotMoveTheJointAfterAHoldWithAMoveThatHeWithheld) {
  const setpoint_v1 first = client_->make_setpoint("elbow", 0.05);
  stranger_.send("SW.elbow.SETPOINT", signed_bytes("SETPOINT", first));
  ASSERT_TRUE(client_->wait_for_answer(first.sequence).accepted)
      << "without a hold it is as good as sent by its owner";
  for (int i = 0; i < 10; ++i) {
    client_->pump(milliseconds(100));
    const setpoint_v1 move = client_->make_setpoint("elbow", 0.5);
    const Bytes withheld = signed_bytes("SETPOINT", move);
    stranger_stops(Action::kHold);
    stranger_.send("SW.elbow.SETPOINT", withheld);
    const Answer late = client_->wait_for_answer(move.sequence);
    EXPECT_EQ(late.reason, Reason::kSuperseded) << late.text;
  }
  client_->pump(milliseconds(500));
  EXPECT_EQ(mode(), static_cast<std::int32_t>(Mode::kHolding));
  EXPECT_NEAR(client_->state("elbow")->joint_position_rad, 0.05, 1e-2);
}

TEST_F(StrangerTest, CannotEnableTheJointAfterADisableWithAnEnableThatHeWithheld) {
  for (int i = 0; i < 5; ++i) {
    const command_v1 enable_order = client_->make_command("elbow", Action::kEnable);
    const Bytes withheld = signed_bytes("COMMAND", enable_order);
    stranger_stops(Action::kDisable);
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kOff));
    stranger_.send("SW.elbow.COMMAND", withheld);
    const Answer late = client_->wait_for_answer(enable_order.sequence);
    EXPECT_EQ(late.reason, Reason::kSuperseded) << late.text;
    client_->pump(milliseconds(100));
    EXPECT_EQ(mode(), static_cast<std::int32_t>(Mode::kOff));
    enable(*client_);
  }
}

TEST_F(StrangerTest, KeepsNoAnswerToAnHonestHoldBackByForging1200HoldsASecond) {
  listen(milliseconds(50));
  RawCommand hold = forged(Action::kHold);
  const Barrage barrage(1200, [&] {
    hold.challenge = challenge_;
    ++hold.sequence;
    ++hold.signature[static_cast<std::size_t>(hold.sequence) % hold.signature.size()];
    stranger_.send("SW.elbow.COMMAND", hold.bytes());
  });
  listen(milliseconds(1000));
  for (int i = 0; i < 5; ++i) {
    const Answer answer = insist(client_->make_command("elbow", Action::kHold));
    EXPECT_TRUE(answer.accepted) << i << ": " << answer.text;
  }
  EXPECT_EQ(mode(), static_cast<std::int32_t>(Mode::kHolding));
  EXPECT_GT(barrage.fired(), 100);
}

TEST_F(StrangerTest, CannotKeepADisableFromBeingObeyedByTenThousandCraftedDatagramsASecond) {
  const pid_t gateway = daemon_->gateway_pid();
  std::array<Stranger, 8> ports;
  for (int i = 0; i < 10; ++i) {
    listen(milliseconds(300));
    if (i > 0) enable(*client_);
    RawCommand order = forged(Action::kEnable);
    // Each volley has ten datagrams: crashing fragments, a message in parts, orders with a wrong signature, and noise.
    const Barrage barrage(1000, [&] {
      const auto number = static_cast<std::uint32_t>(++order.sequence);
      Stranger& port = ports[number % ports.size()];
      order.challenge = challenge_;
      for (const Bytes& part : crashing_fragments("SW.elbow.COMMAND", number)) port.send(part);
      for (const Bytes& part : fragments("SW.elbow.TABLE", pattern(3000), 1000, number)) port.send(part);
      for (std::size_t n = 0; n < 4; ++n) {
        ++order.signature[n];
        port.send("SW.elbow.COMMAND", order.bytes());
      }
      port.send(pattern(200, number));
    });
    listen(milliseconds(100));
    ASSERT_EQ(mode(), static_cast<std::int32_t>(Mode::kHolding)) << i;
    const Answer answer = insist(client_->make_command("elbow", Action::kDisable));
    EXPECT_TRUE(answer.accepted) << i << ": " << answer.text;
    EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kOff)) << i;
  }
  EXPECT_EQ(daemon_->gateway_pid(), gateway) << daemon_->log();
  EXPECT_TRUE(daemon_->wait_for_log("malformed datagrams", std::chrono::seconds(30)))
      << "the barrage did not come in";
}

TEST_F(StrangerTest, UsesUpNobodysSequenceAndLease) {
  for (int i = 0; i < 100; ++i) {
    client_->pump(milliseconds(2));
    challenge_ = client_->state("elbow")->challenge;
    RawCommand order = forged(Action::kTakeOver);
    order.sender_id = client_->sender_id();
    order.sequence = INT64_MAX - i;
    stranger_.send("SW.elbow.COMMAND", order.bytes());
    order.key_id = Bytes(8);
    order.signature = Bytes(64);
    stranger_.send("SW.elbow.COMMAND", order.bytes());
  }
  const Answer honest = send(*client_, "SETPOINT", client_->make_setpoint("elbow", 0.1));
  EXPECT_TRUE(honest.accepted) << honest.text;
  EXPECT_EQ(client_->state("elbow")->owner_id, client_->sender_id());
}

TEST_F(StrangerTest, WritesNoLineOfHisOwnIntoTheLogAndCommandsNoTerminal) {
  for (int i = 0; i < 200; ++i) {
    stranger_.send("SW.\n<0>elbow: \x1b[2Jgone", Bytes(20));
    stranger_.send("SW.elbow.\x1b]0;title\x07\n<0>forged", Bytes(20));
    stranger_.send("SW.elbow\u202EDNAMMOC.COMMAND", Bytes(20));
    stranger_.send(
        "SW.elbow\x9B"
        "2J.COMMAND",
        Bytes(20));
    client_->pump(milliseconds(1));
  }
  client_->pump(milliseconds(300));
  const std::string log = daemon_->log();
  EXPECT_EQ(log.find('\x1b'), std::string::npos);
  EXPECT_EQ(log.find("\n<0>"), std::string::npos);
  EXPECT_EQ(log.find('\x9B'), std::string::npos);
  EXPECT_EQ(log.find("\u202E"), std::string::npos);
  EXPECT_NE(log.find("SW.elbow?DNAMMOC"), std::string::npos) << log;
  EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 100);
}

}  // namespace
}  // namespace strainwave::testing
