// SPDX-License-Identifier: BSD-3-Clause
// watch on a real (pseudo) terminal, as its user starts it. It takes the whole screen, follows its size and restores the terminal.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <strainwave/state_v1.hpp>
#include <thread>

#include "client/protocol/clock.h"
#include "client/protocol/connection.h"
#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"
#include "tests/support/fragment_attack.h"
#include "tests/support/own_port.h"

namespace strainwave {
namespace {

class WatchOnATerminal : public ::testing::Test {
 protected:
  void SetUp() override {
    url_ = testing::own_url();
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(master_, 0);
    ASSERT_EQ(::grantpt(master_), 0);
    ASSERT_EQ(::unlockpt(master_), 0);
    resize(24, 120);
    const std::string terminal = ::ptsname(master_);  // NOLINT(concurrency-mt-unsafe)
    child_ = ::fork();
    if (child_ == 0) run_watch(terminal);
    lcm_.emplace(url_);
  }
  void TearDown() override {
    if (child_ > 0) ::kill(child_, SIGKILL);
    if (child_ > 0) ::waitpid(child_, nullptr, 0);
    ::close(master_);
  }
  [[noreturn]] void run_watch(const std::string& terminal) const {
    ::setsid();
    const int slave = ::open(terminal.c_str(), O_RDWR);
    ::ioctl(slave, TIOCSCTTY, 0);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(slave, descriptor);
    ::setenv("TERM", "xterm", 1);
    ::setenv("LC_ALL", "C.UTF-8", 1);
    const std::string program = std::string(STRAINWAVE_BINARY_DIR) + "/bin/strainwavectl";
    ::execl(program.c_str(), program.c_str(), "--lcm-url", url_.c_str(), "--timeout_s", "20", "watch",
            nullptr);
    ::_exit(127);
  }
  void resize(unsigned short rows, unsigned short columns) const {
    const winsize size{rows, columns, 0, 0};
    ASSERT_EQ(::ioctl(master_, TIOCSWINSZ, &size), 0);
  }
  void publish() {
    state_v1 state{};
    state.session_id = 1;
    state.mode = static_cast<std::int32_t>(Mode::kHolding);
    lcm_->publish("SW.elbow.STATE", encode(state));
  }
  /// Publishes states and reads what the program writes until it has written `text`; false after 20 s.
  bool wait_for_text(const std::string& text) {
    for (const Deadline end(20.0); !end.passed();) {
      publish();
      pollfd descriptor{master_, POLLIN, 0};
      std::array<char, 4096> bytes{};
      if (::poll(&descriptor, 1, 20) > 0) {
        const ssize_t count = ::read(master_, bytes.data(), bytes.size());
        if (count > 0) written_.append(bytes.data(), static_cast<std::size_t>(count));
      }
      if (written_.find(text) != std::string::npos) return true;
    }
    return false;
  }
  void press(char key) const { ASSERT_EQ(::write(master_, &key, 1), 1); }
  /// Returns the exit status, or -1 when the program still runs after 20 s.
  int wait_for_end() {
    int status = 0;
    for (const Deadline end(20.0); !end.passed();) {
      publish();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (::waitpid(child_, &status, WNOHANG) == child_) {
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
    }
    return -1;
  }

  std::string url_;
  int master_ = -1;
  pid_t child_ = -1;
  std::optional<Connection> lcm_;
  std::string written_;
};

constexpr const char* kEnterScreen = "\x1b[?1049h";
constexpr const char* kLeaveScreen = "\x1b[?1049l";

TEST_F(WatchOnATerminal, StartsFollowsTheSizeAndGivesTheTerminalBack) {
  ASSERT_TRUE(wait_for_text(kEnterScreen)) << written_;
  ASSERT_TRUE(wait_for_text("elbow")) << written_;
  ASSERT_TRUE(wait_for_text("holding"));
  ASSERT_TRUE(wait_for_text("s stop"));
  written_.clear();
  resize(4, 25);
  ASSERT_TRUE(wait_for_text("too small")) << written_;
  written_.clear();
  resize(40, 160);
  ASSERT_TRUE(wait_for_text("holding")) << written_;
  press('s');
  ASSERT_TRUE(wait_for_text("disable")) << written_;
  press('q');
  ASSERT_TRUE(wait_for_text(kLeaveScreen)) << written_;
  EXPECT_EQ(wait_for_end(), 0);
}

TEST_F(WatchOnATerminal, GoesOnUnderTheFragmentsThatCrashLcmsLibrary) {
  ASSERT_TRUE(wait_for_text("holding")) << written_;
  const testing::FragmentAttack attack(
      url_, {"SW.elbow.STATE", "SW.elbow.ACK", "SW.elbow.LIMITS", "SW.elbow.TEMPERATURE", "SW.TIMING"});
  while (attack.rounds() < 300) publish(), std::this_thread::sleep_for(std::chrono::milliseconds(5));
  written_.clear();
  resize(40, 160);
  ASSERT_TRUE(wait_for_text("holding")) << written_;
  press('q');
  ASSERT_TRUE(wait_for_text(kLeaveScreen)) << written_;
  EXPECT_EQ(wait_for_end(), 0);
}

TEST_F(WatchOnATerminal, CtrlCEndsItInOrder) {
  ASSERT_TRUE(wait_for_text("holding"));
  press('\x03');
  ASSERT_TRUE(wait_for_text(kLeaveScreen)) << written_;
  EXPECT_EQ(wait_for_end(), 0);
}

}  // namespace
}  // namespace strainwave
