// Somebody without a key who sends orders as fast as he can.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/adversary/signed_daemon.h"

namespace strainwave::testing {
namespace {

/// A child that sends `message` on `channel`, about three thousand times a second, each time with another wrong signature: more
/// than strangers are answered.
class Forger {
 public:
  Forger(const std::string& channel, std::vector<std::uint8_t> message) : pid_(::fork()) {
    if (pid_ != 0) return;
    lcm::LCM lcm(kTestUrl);
    for (;;) {
      for (int i = 0; i < 3; ++i) {
        ++message[message.size() - 1 - tries_++ % sizeof(Signature)];
        lcm.publish(channel, message.data(), static_cast<unsigned int>(message.size()));
      }
      ::usleep(1000);
    }
  }
  ~Forger() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Forger(const Forger&) = delete;
  Forger& operator=(const Forger&) = delete;

 private:
  std::size_t tries_ = 0;
  pid_t pid_;
};

class ForgerTest : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("");
    client_.emplace();
    bring_to_hold(*client_);
  }
  /// Whatever is forged meanwhile, each stop is obeyed and acknowledged, with a signature and without.
  void expect_stops(bool with_signature) {
    constexpr int kStops = 25;  // one of several is answered by luck
    for (int i = 0; i < kStops; ++i) {
      const command_v1 stop = client_->make_command("elbow", Action::kDisable);
      const Answer answer =
          with_signature ? send(*client_, "COMMAND", stop) : client_->send_and_wait("elbow", "COMMAND", stop);
      EXPECT_TRUE(answer.accepted) << i << ": " << answer.text;
      EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kOff)) << i;
    }
  }
  template <typename Message>
  std::vector<std::uint8_t> signed_bytes(const char* kind, const Message& message) {
    std::vector<std::uint8_t> bytes = encode(message);
    sign(std::string("SW.elbow.") + kind, key_, bytes);
    return bytes;
  }

  std::optional<TestClient> client_;
};

TEST_F(ForgerTest, OfMovesKeepsNoAnswerToAStopBack) {
  const Forger forger("SW.elbow.SETPOINT", signed_bytes("SETPOINT", client_->make_setpoint("elbow", 1.0)));
  client_->pump(std::chrono::seconds(1));
  EXPECT_NEAR(client_->state("elbow")->joint_position_rad, 0.0, 1e-2);
  expect_stops(true);
  expect_stops(false);
}

TEST_F(ForgerTest, OfStopsKeepsNoAnswerToAStopBack) {
  command_v1 stop = client_->make_command("elbow", Action::kDisable);
  const Forger forger("SW.elbow.COMMAND", signed_bytes("COMMAND", stop));
  // Until what it quotes is too old to be verified; more than are verified, and recent, would cost answers (docs/security.md).
  const std::int64_t from = client_->state("elbow")->cycle;
  ASSERT_TRUE(
      client_->wait_for_state("elbow", [&](const state_v1& state) { return state.cycle > from + 3000; }));
  expect_stops(true);
}

}  // namespace
}  // namespace strainwave::testing
