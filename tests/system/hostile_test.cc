// SPDX-License-Identifier: BSD-3-Clause
// The daemon under attack: the loop must not be disturbed, whatever happens to the gateway.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/system/attacked_daemon.h"
#include "tests/system/hostile_datagrams.h"

namespace strainwave::testing {
namespace {

using HostileSystem = AttackedDaemon;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// Datagrams of two seconds, unless $STRAINWAVE_HOSTILE_DATAGRAMS is set.
std::int64_t datagrams() {
  const char* text =
      std::getenv("STRAINWAVE_HOSTILE_DATAGRAMS");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return text != nullptr ? std::stoll(text) : 100'000;
}

constexpr double kDatagramsPer_s = 50'000.0;

/// A child process that sends the datagrams while the parent observes.
class Attacker {
 public:
  explicit Attacker(std::uint64_t seed) : pid_(::fork()) {
    if (pid_ == 0) ::_exit(send_hostile_datagrams(datagrams(), seed, kDatagramsPer_s) == datagrams() ? 0 : 1);
  }
  ~Attacker() {
    if (status_ != -1) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;
  bool finished() {
    int status = 0;
    if (status_ == -1 && ::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    return status_ != -1;
  }
  int status() const { return status_; }

 private:
  pid_t pid_;
  int status_ = -1;
};

TEST_F(HostileSystem, HostileDatagramsDisturbNeitherTheLoopNorItsTorque) {
  // The same part of the same move is observed without and with the attack.
  const double duration_s = static_cast<double>(datagrams()) / kDatagramsPer_s;
  start_tracking();
  const LoopObserver::Summary calm = observe_for(duration_s);
  report("calm", calm, duration_s);
  start_tracking();

  GatewayWatch watch(*daemon_);
  const auto start = Clock::now();
  Attacker attacker(20260101);
  const LoopObserver::Summary attacked = observe_until([&] {
    watch.look();
    return attacker.finished();
  });
  const double attack_s = seconds_since(start);
  report("attacked", attacked, attack_s);
  std::printf("%lld datagrams sent in %.1f s, %d restarts of the gateway, away for at most %.3f s\n",
              static_cast<long long>(datagrams()), attack_s, watch.restarts(), watch.longest_absence_s());
  EXPECT_EQ(attacker.status(), 0) << "not all datagrams were sent";
  expect_undisturbed(attacked, calm, attack_s);
  EXPECT_EQ(watch.restarts(), 0);
  std::this_thread::sleep_for(seconds(1));
  expect_orders_obeyed();
  TestClient client;
  ASSERT_TRUE(client.wait_for_timing());
  std::int64_t refused = 0;
  for (const std::int64_t count : client.timing()->rejects) refused += count;
  std::printf("%lld messages reached the core and were refused\n", static_cast<long long>(refused));
  EXPECT_GT(refused, 1000) << "the attack did not get through to the core: it proves nothing";
  // One line for every refusal would fill a disk.
  const std::string log = daemon_->log();
  EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 200);
}

TEST_F(HostileSystem, AKilledGatewayIsBackWithinASecondEachTimeAndIsObeyed) {
  start_tracking();
  const LoopObserver::Summary calm = observe_for(2.0);
  GatewayWatch watch(*daemon_);
  constexpr int kKills = 6;
  const auto start = Clock::now();
  auto killed = Clock::now();
  const LoopObserver::Summary attacked = observe_until([&] {
    watch.look();
    if (watch.restarts() == kKills) return true;
    const pid_t gateway = daemon_->gateway_pid();
    // Each new gateway is killed once, after some time to work.
    if (gateway > 0 && seconds_since(killed) > 1.5) {
      if (watch.restarts() > 0) std::printf("back after %.3f s\n", watch.last_absence_s());
      ::kill(gateway, SIGKILL);
      killed = Clock::now();
    }
    return seconds_since(start) > 60.0;
  });
  std::printf("back after %.3f s\n", watch.last_absence_s());
  EXPECT_EQ(watch.restarts(), kKills);
  EXPECT_LT(watch.longest_absence_s(), 1.0);
  expect_undisturbed(attacked, calm, seconds_since(start));
  expect_orders_obeyed();
}

TEST_F(HostileSystem, AStoppedGatewayIsReplacedAndTheLoopDoesNotNotice) {
  start_tracking();
  const LoopObserver::Summary calm = observe_for(2.0);
  const pid_t old = daemon_->gateway_pid();
  ASSERT_EQ(::kill(old, SIGSTOP), 0);
  constexpr double kStopped_s = 6.0;
  const LoopObserver::Summary attacked = observe_for(kStopped_s);
  expect_undisturbed(attacked, calm, kStopped_s);
  EXPECT_NE(daemon_->gateway_pid(), old);
  EXPECT_NE(daemon_->log().find("has done nothing"), std::string::npos) << daemon_->log();
  expect_orders_obeyed();
}

TEST_F(HostileSystem, AFullLogDiskIsNotNoticed) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  start_tracking({{}, full});
  const LoopObserver::Summary calm = observe_for(2.0);
  const LoopObserver::Summary attacked = refuse_orders_for(3.0);
  expect_undisturbed(attacked, calm, 3.0);
  expect_orders_obeyed();
  ::close(full);
}

TEST_F(HostileSystem, ALogThatNobodyReadsKeepsNoOrderBack) {
  int pipe[2];
  ASSERT_EQ(::pipe2(pipe, O_CLOEXEC), 0);
  const std::string page(4096, 'x');
  ASSERT_EQ(::fcntl(pipe[1], F_SETFL, O_NONBLOCK), 0);
  while (::write(pipe[1], page.data(), page.size()) > 0) {
  }
  ASSERT_EQ(::fcntl(pipe[1], F_SETFL, 0), 0);
  start_tracking({{}, pipe[1]});
  const LoopObserver::Summary calm = observe_for(2.0);
  const LoopObserver::Summary attacked = refuse_orders_for(3.0);
  expect_undisturbed(attacked, calm, 3.0);
  expect_orders_obeyed();
  // Once the log is read, it reports the lost lines.
  std::string text(1 << 20, '\0');
  ASSERT_GT(::read(pipe[0], text.data(), text.size()), 0);
  daemon_->signal(SIGTERM);
  EXPECT_EQ(daemon_->wait_for_end(seconds(10)), 0);
  const ssize_t length = ::read(pipe[0], text.data(), text.size());
  ASSERT_GT(length, 0);
  EXPECT_NE(text.substr(0, static_cast<std::size_t>(length)).find("lines of this log lost"),
            std::string::npos);
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST_F(HostileSystem, ASubscriberThatNeverReadsHoldsUpNobody) {
  start_tracking();
  const LoopObserver::Summary calm = observe_for(3.0);
  const int reader = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ASSERT_EQ(::setsockopt(reader, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes), 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  ASSERT_EQ(::bind(reader, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ip_mreq group{};
  ::inet_pton(AF_INET, "239.255.76.67", &group.imr_multiaddr);
  ASSERT_EQ(::setsockopt(reader, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group), 0);
  const LoopObserver::Summary attacked = observe_for(3.0);
  expect_undisturbed(attacked, calm, 3.0);
  expect_orders_obeyed();
  ::close(reader);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
std::string status_line(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":"))
      return line.substr(std::min(line.find_first_not_of(" \t", key.size() + 1), line.size()));
  return "absent";
}

TEST_F(HostileSystem, TheGatewayRunsWithoutPrivilegesInEveryThread) {
  start_tracking();
  const std::string process = "/proc/" + std::to_string(daemon_->gateway_pid());
  int threads = 0;
  for (const auto& task : std::filesystem::directory_iterator(process + "/task")) {
    const std::string status = task.path().string() + "/status";
    EXPECT_EQ(status_line(status, "Seccomp"), "2");
    EXPECT_EQ(status_line(status, "NoNewPrivs"), "1");
    for (const char* set : {"CapInh", "CapPrm", "CapEff", "CapAmb"})
      EXPECT_EQ(status_line(status, set), "0000000000000000") << set;
    if (::geteuid() == 0) {
      EXPECT_EQ(status_line(status, "CapBnd"), "0000000000000000");
    }
    ++threads;
  }
  EXPECT_EQ(threads, 1) << "LCM's library has begun to receive: it does so in a thread of its own";
}

TEST_F(HostileSystem, StartedByRootTheGatewayIsAnotherUserWithNothingOpenButItsChannels) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can start it as another user";
  start_tracking();
  if (daemon_->log().find("gateway: as the daemon's own user") != std::string::npos)
    GTEST_SKIP() << "this user namespace has no other user";
  const std::string process = "/proc/" + std::to_string(daemon_->gateway_pid());
  EXPECT_NE(status_line(process + "/status", "Uid").substr(0, 2), "0\t");
  EXPECT_EQ(status_line(process + "/status", "Groups"), "");
  for (const auto& entry : std::filesystem::directory_iterator(process + "/fd")) {
    const std::string target = std::filesystem::read_symlink(entry.path());
    const bool known = target == "/dev/null" || target.starts_with("/memfd:strainwave-") ||
                       target.starts_with("socket:") || target.starts_with("pipe:");
    EXPECT_TRUE(known) << target;
  }
}
#endif

}  // namespace
}  // namespace strainwave::testing
