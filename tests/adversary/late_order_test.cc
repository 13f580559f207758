// SPDX-License-Identifier: BSD-3-Clause
// Orders of our own programs that reach the daemon late, because the network delayed them or the program was suspended. Meanwhile another client
// stops the joint, and the joint must stay stopped.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <strainwave/setpoint_v1.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client/protocol/orders.h"
#include "drivers/injected_fault.h"
#include "lcmtypes/key_text.h"
#include "tests/adversary/relay.h"
#include "tests/adversary/signed_daemon.h"

namespace strainwave::testing {
namespace {

/// strainwavectl as a child process, with the engineer's key.
class Program {
 public:
  Program(const std::filesystem::path& key, std::vector<std::string> words) {
    words.insert(words.begin(), {programs_folder() / "strainwavectl", "--lcm-url", kTestUrl, "--key", key});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
  }
  ~Program() {
    if (pid_ > 0) (void)wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const { ::kill(pid_, number); }
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    return WEXITSTATUS(status);
  }

 private:
  pid_t pid_;
};

class LateOrder : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("lcm_url = \"" + std::string(kInsideUrl) + "\"\n");
    std::ofstream(key_file_) << to_line(SecretKeyText{key_, Role::kEngineer, "test"}) << '\n';
    std::filesystem::permissions(key_file_, std::filesystem::perms::owner_read);
    relay_.emplace();
    other_.emplace("SW", kInsideUrl);
    bring_to_hold(*other_);
    ASSERT_TRUE(send(*other_, "COMMAND", other_->make_command("elbow", Action::kRelease)).accepted);
    before_rad_ = other_->state("elbow")->joint_position_rad;
  }
  /// Sends an order of another client, with its own key and a direct path to the daemon.
  void other_orders(Action action) {
    const Answer answer = send(*other_, "COMMAND", other_->make_command("elbow", action), operator_key_);
    ASSERT_TRUE(answer.accepted) << to_text(action) << ": " << answer.text;
  }
  void pump(double seconds) { other_->pump(std::chrono::milliseconds(static_cast<int>(1e3 * seconds))); }
  void expect_that_the_joint_stays(Mode mode) {
    pump(2.0);
    EXPECT_EQ(other_->state("elbow")->mode, static_cast<std::int32_t>(mode)) << daemon_->log();
    EXPECT_NEAR(other_->state("elbow")->joint_position_rad, before_rad_, 1e-3);
  }
  /// Delays a move. After 0.3 s another client holds the joint, and `delay_s` after it was sent the move reaches the daemon.
  void deliver_a_move_late(double delay_s, bool suspended) {
    relay_->keep_back(true);
    Program move(key_file_, {"move", "elbow", "0.89"});
    while (relay_->kept() == 0) pump(0.005);
    if (suspended) move.signal(SIGSTOP);
    pump(0.3);
    other_orders(Action::kHold);
    pump(delay_s - 0.3);
    relay_->deliver();
    relay_->keep_back(false);
    pump(0.2);
    move.signal(SIGCONT);
    EXPECT_NE(move.wait(), 0);
    expect_that_the_joint_stays(Mode::kHolding);
  }
  /// A client that pauses for 1.5 s between reading the state and sending `message`. Meanwhile `happens` runs.
  template <typename Message, typename Happens>
  Reason reason_after_standing_still(std::string_view kind, Message message, const Happens& happens) {
    Connection connection(kTestUrl);
    Client client(connection, {"SW", 5.0, key_file_});
    bool first = true;
    return client
        .request("elbow", kind, message,
                 [&](Message&) {
                   if (!std::exchange(first, false)) return;
                   happens();
                   pump(1.5);
                 })
        .reason;
  }

  const std::filesystem::path key_file_ = folder_ / "secret";
  std::optional<Relay> relay_;
  std::optional<TestClient> other_;
  double before_rad_ = 0.0;
};

TEST_F(LateOrder, DoesNotMoveAJointThatWasHeldWhileItWasKeptBack) {
  for (const double delay_s : {1.2, 1.5, 1.9}) deliver_a_move_late(delay_s, false);
}

TEST_F(LateOrder, DoesNotMoveAJointThatWasHeldWhileItsProgramWasSuspended) {
  deliver_a_move_late(4.0, true);
}

TEST_F(LateOrder, IsNotGivenAnewOverAHoldByAProgramThatStoodStill) {
  setpoint_v1 move{};
  move.position_rad = 0.5;
  move.acknowledge = 1;
  EXPECT_EQ(reason_after_standing_still("SETPOINT", move, [&] { other_orders(Action::kHold); }),
            Reason::kTooOld);
  expect_that_the_joint_stays(Mode::kHolding);
}

TEST_F(LateOrder, IsNotGivenAnewOverADisableAndEnable) {
  setpoint_v1 move{};
  move.position_rad = 0.5;
  move.acknowledge = 1;
  EXPECT_EQ(reason_after_standing_still("SETPOINT", move,
                                        [&] {
                                          other_orders(Action::kDisable);
                                          ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kOff));
                                          other_orders(Action::kEnable);
                                          ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kHolding));
                                          other_orders(Action::kRelease);
                                        }),
            Reason::kTooOld);
  expect_that_the_joint_stays(Mode::kHolding);
}

TEST_F(LateOrder, DoesNotEnableAJointThatWasDisabledMeanwhile) {
  other_orders(Action::kDisable);
  ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kOff));
  command_v1 enable{};
  enable.action = static_cast<std::int32_t>(Action::kEnable);
  EXPECT_EQ(reason_after_standing_still("COMMAND", enable, [&] { other_orders(Action::kDisable); }),
            Reason::kTooOld);
  expect_that_the_joint_stays(Mode::kOff);
}

TEST_F(LateOrder, DoesNotClearAFaultThatCameMeanwhile) {
  const auto fault = [&] {
    const inject_v1 injection =
        other_->make_injection("elbow", static_cast<std::int32_t>(InjectedFault::kPowerLost), 0.01, 0.0);
    ASSERT_TRUE(send(*other_, "INJECT", injection).accepted);
    ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kFaulted)) << daemon_->log();
  };
  fault();
  command_v1 clear{};
  clear.action = static_cast<std::int32_t>(Action::kClearFault);
  EXPECT_EQ(reason_after_standing_still("COMMAND", clear,
                                        [&] {
                                          pump(0.3);
                                          other_orders(Action::kClearFault);
                                          ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kOff));
                                          other_orders(Action::kEnable);
                                          ASSERT_TRUE(other_->wait_for_mode("elbow", Mode::kHolding));
                                          other_orders(Action::kRelease);
                                          fault();
                                        }),
            Reason::kTooOld);
  expect_that_the_joint_stays(Mode::kFaulted);
}

}  // namespace
}  // namespace strainwave::testing
