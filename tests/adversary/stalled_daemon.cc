// SPDX-License-Identifier: BSD-3-Clause
// The running daemon is suspended during a motion, or receives every signal that can end a process.
#include <signal.h>

#include <array>
#include <thread>
#include <vector>

#include "daemon/gateway/sanitized.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {
namespace {

using std::chrono::seconds;

class StalledDaemon : public DaemonTest {
 protected:
  void move(const std::string& limits) {
    daemon_.reset();
    client_.reset();
    std::string text = configuration();
    const std::string key = "stall_limit_s = 100\n";
    if (const std::size_t place = text.find(key); place != std::string::npos)
      text.replace(place, key.size(), limits);
    daemon_.emplace(folder_, text);
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(client_->load("elbow", shipped_table()).accepted);
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    ASSERT_TRUE(client_->move("elbow", 3.0).accepted);
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1& state) {
      return state.mode == static_cast<std::int32_t>(Mode::kTracking) && state.joint_position_rad > 0.1;
    })) << daemon_->log();
  }
  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(StalledDaemon, FaultsItsJointsWhenItHasBeenStoppedForThreeSeconds) {
  move("stall_limit_s = 1\n");
  daemon_->signal(SIGSTOP);
  std::this_thread::sleep_for(seconds(3));
  daemon_->signal(SIGCONT);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kFaulted)) << daemon_->log();
  EXPECT_EQ(client_->state("elbow")->fault, static_cast<int>(Fault::kLoopStalled)) << daemon_->log();
  EXPECT_EQ(client_->state("elbow")->torque_commanded_Nm, 0.0);
}

TEST_F(StalledDaemon, EndsInOrderByEverySignalThatMayBeSent) {
  std::vector<int> signals{SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGPIPE, SIGRTMIN};
  // Another process can send these signals too, not only the kernel.
  if (!kSanitized) signals.insert(signals.end(), {SIGABRT, SIGSYS, SIGSEGV, SIGBUS, SIGFPE, SIGILL});
  for (const int signal : signals) {
    move("stall_limit_s = 100\n");
    daemon_->signal(signal);
    if (signal == SIGPIPE) {  // a closed log must not end the daemon
      client_->pump(std::chrono::milliseconds(200));
      EXPECT_TRUE(daemon_->running());
      daemon_->signal(SIGTERM);
    }
    EXPECT_EQ(daemon_->wait_for_end(seconds(10)), 0) << "signal " << signal << ": " << daemon_->log();
    EXPECT_TRUE(daemon_->wait_for_log("every joint is at rest", seconds(1))) << signal;
  }
}

TEST_F(StalledDaemon, DoesNotStandStillForATerminal) {
  move("stall_limit_s = 1\n");
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) daemon_->signal(signal);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  EXPECT_EQ(client_->state("elbow")->fault, 0);
}

TEST_F(StalledDaemon, ObeysNoEnableOnceItEnds) {
  move("stall_limit_s = 100\n");
  daemon_->signal(SIGTERM);
  bool accepted = false;
  while (daemon_->running()) {
    command_v1 enable = client_->make_command("elbow", Action::kEnable);
    client_->lcm().publish("SW.elbow.COMMAND", &enable);
    const Answer answer = client_->wait_for_answer(enable.sequence, std::chrono::milliseconds(20));
    accepted = accepted || answer.accepted;
  }
  EXPECT_FALSE(accepted);
  EXPECT_EQ(daemon_->wait_for_end(seconds(1)), 0);
}

}  // namespace
}  // namespace strainwave::testing
