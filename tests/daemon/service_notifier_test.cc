// SPDX-License-Identifier: BSD-3-Clause
// Messages to the service manager, received on a socket that the test provides in its place.
#include "daemon/service_notifier.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

class ServiceManager : public ::testing::Test {
 protected:
  void SetUp() override {
    socket_.reset(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_.path() / "notify";
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "400000", 1);
    ::unsetenv("WATCHDOG_PID");
  }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) ::unsetenv(name);
  }
  std::vector<std::string> heard() const {
    std::vector<std::string> messages;
    std::array<char, 4096> text{};
    for (ssize_t size = 0; (size = ::recv(socket_.get(), text.data(), text.size(), 0)) > 0;)
      messages.emplace_back(text.data(), static_cast<std::size_t>(size));
    return messages;
  }

 private:
  TemporaryFolder folder_;
  UniqueFd socket_;
};

using Messages = std::vector<std::string>;

TEST(TimingProof, NeedsCyclesInARowWithoutASkippedPeriod) {
  TimingProof proof(100);
  EXPECT_FALSE(proof.update(99, 0));
  EXPECT_FALSE(proof.update(120, 1)) << "a period was skipped: the count begins again";
  EXPECT_FALSE(proof.update(219, 1));
  EXPECT_TRUE(proof.update(220, 1));
}

TEST(TimingProof, IsGivenOnce) {
  TimingProof proof(100);
  EXPECT_TRUE(proof.update(100, 0));
  EXPECT_TRUE(proof.update(101, 7)) << "later overruns are the loop's own matter: missed_share_limit";
}

TEST_F(ServiceManager, HearsReadyOnceAndOnlyWhenTheTimingIsMet) {
  ServiceNotifier notifier;
  notifier.update(10, 0, 0);
  EXPECT_EQ(heard(), Messages{"WATCHDOG=1"});
  notifier.update(60, 3, kMillisecond_ns);
  EXPECT_TRUE(heard().empty());
  EXPECT_FALSE(notifier.ready());
  notifier.update(160, 3, 2 * kMillisecond_ns);
  EXPECT_EQ(heard(), Messages{"READY=1"});
  EXPECT_TRUE(notifier.ready());
  notifier.update(161, 3, 3 * kMillisecond_ns);
  EXPECT_TRUE(heard().empty());
}

TEST_F(ServiceManager, HearsFourTimesWithinTheWatchdogsTimeThatTheLoopGoesRound) {
  ServiceNotifier notifier;
  std::size_t alive = 0;
  for (int now_ms = 0; now_ms < 400; ++now_ms) {
    notifier.update(now_ms + 1, 1, now_ms * kMillisecond_ns);
    for (const std::string& message : heard())
      if (message == "WATCHDOG=1") ++alive;
  }
  EXPECT_EQ(alive, 4U);
}

TEST_F(ServiceManager, HearsNothingOfALoopThatStandsStill) {
  ServiceNotifier notifier;
  notifier.update(5, 0, 0);
  EXPECT_EQ(heard(), Messages{"WATCHDOG=1"});
  for (int now_ms = 1; now_ms < 2000; ++now_ms) notifier.update(5, 0, now_ms * kMillisecond_ns);
  EXPECT_TRUE(heard().empty());
}

TEST_F(ServiceManager, SeesAStatusWhenItHasChanged) {
  ServiceNotifier notifier;
  notifier.show("elbow off");
  notifier.show("elbow off");
  notifier.show("elbow holding");
  notifier.stopping();
  EXPECT_EQ(heard(), (Messages{"STATUS=elbow off", "STATUS=elbow holding", "STOPPING=1"}));
}

}  // namespace
}  // namespace strainwave
