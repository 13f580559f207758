// SPDX-License-Identifier: BSD-3-Clause
// Restarts of the gateway, with programs that end at once or never.
#include "daemon/gateway/gateway_process.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

#include "base/unique_fd.h"
#include "daemon/gateway/descriptor_message.h"
#include "daemon/gateway/wake_pipe.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// A program that does not end by itself.
class EndlessProgram {
 public:
  EndlessProgram() {
    std::ofstream(path()) << "#!/bin/sh\nexec sleep 1000\n";
    ::chmod(path().c_str(), 0700);
  }
  EndlessProgram(const EndlessProgram&) = delete;
  EndlessProgram& operator=(const EndlessProgram&) = delete;
  std::string path() const { return folder_.path() / "endless"; }

 private:
  TemporaryFolder folder_;
};

/// Waits for the end of the child, which takes real time. The back-off uses the clock `now_ns`.
std::string wait_for_end(GatewayProcess& gateway, std::int64_t now_ns) {
  for (int i = 0; i < 1000; ++i) {
    if (const auto end = gateway.take_end(now_ns)) return *end;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return "none";
}

std::int64_t wait_until_due_ms(const GatewayProcess& gateway, std::int64_t now_ns) {
  std::int64_t waited_ms = 0;
  while (!gateway.start_due(now_ns + waited_ms * kMillisecond_ns)) ++waited_ms;
  return waited_ms;
}

TEST(GatewayProcess, ComesBackEverMoreSlowlyButAlwaysWithinASecond) {
  GatewayProcess gateway("/bin/false", {0, 1, 2});
  std::int64_t now_ns = 0;
  std::vector<std::int64_t> waits_ms;
  for (int i = 0; i < 8; ++i) {
    gateway.start(now_ns);
    EXPECT_EQ(wait_for_end(gateway, now_ns), "exit status 1");
    waits_ms.push_back(wait_until_due_ms(gateway, now_ns));
    now_ns += waits_ms.back() * kMillisecond_ns;
  }
  EXPECT_EQ(waits_ms, (std::vector<std::int64_t>{100, 200, 400, 800, 800, 800, 800, 800}));
}

TEST(GatewayProcess, IsQuickAgainAfterALifeLongEnough) {
  const EndlessProgram program;
  GatewayProcess gateway(program.path(), {0, 1, 2});
  std::int64_t now_ns = 0;
  for (int i = 0; i < 3; ++i) {
    gateway.start(now_ns);
    gateway.kill();
    EXPECT_EQ(wait_for_end(gateway, now_ns), "signal 9");
    now_ns += wait_until_due_ms(gateway, now_ns) * kMillisecond_ns;
  }
  gateway.start(now_ns);
  gateway.kill();
  now_ns += 6000 * kMillisecond_ns;
  EXPECT_EQ(wait_for_end(gateway, now_ns), "signal 9");
  EXPECT_EQ(wait_until_due_ms(gateway, now_ns), 100);
}

// An upgrade of the package replaces the file while the daemon runs.
TEST(GatewayProcess, GoesOnWithTheProgramItHasOpened) {
  const EndlessProgram program;
  GatewayProcess gateway(program.path(), {0, 1, 2});
  std::filesystem::remove(program.path());
  std::ofstream(program.path()) << "#!/bin/sh\nexit 3\n";
  ::chmod(program.path().c_str(), 0700);
  gateway.start(0);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(gateway.take_end(0).has_value());
}

TEST(GatewayProcess, WaitsAlsoWhenTheProgramCannotBeStarted) {
  GatewayProcess gateway("/nonexistent/strainwave-gateway", {0, 1, 2});
  EXPECT_THROW(gateway.start(0), std::system_error);
  EXPECT_EQ(wait_until_due_ms(gateway, 0), 100);
}

TEST(GatewayProcess, TakesItsChildAlong) {
  pid_t pid = -1;
  {
    const EndlessProgram program;
    GatewayProcess gateway(program.path(), {0, 1, 2});
    gateway.start(0);
    pid = gateway.pid();
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_EQ(::kill(pid, 0), -1);
}

/// Accepts connections to a socket, like a service manager.
class ServiceSocket {
 public:
  ServiceSocket() : listener_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path().copy(&address.sun_path[0], sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.get(), 4), 0);
  }
  std::string path() const { return folder_.path() / "core"; }
  UniqueFd accept() const { return UniqueFd(::accept(listener_.get(), nullptr, nullptr)); }

 private:
  TemporaryFolder folder_;
  UniqueFd listener_;
};

ino_t file_of(int descriptor) {
  struct stat status {};
  EXPECT_EQ(::fstat(descriptor, &status), 0);
  return status.st_ino;
}

TEST(GatewayProcess, HandsItsDescriptorsAndItsProgramToAServiceOfAnotherUser) {
  const ServiceSocket service;
  const WakePipe first;
  const WakePipe second;
  const WakePipe third;
  GatewayProcess gateway("/bin/true", {first.core_end(), second.core_end(), third.gateway_end()},
                         service.path());
  gateway.start(0);
  EXPECT_TRUE(gateway.running());
  UniqueFd connection = service.accept();
  const auto passed = receive_descriptors(connection.get());
  EXPECT_EQ(file_of(passed[0]), file_of(first.core_end()));
  EXPECT_EQ(file_of(passed[1]), file_of(second.core_end()));
  EXPECT_EQ(file_of(passed[2]), file_of(third.gateway_end()));
  struct stat program {};
  ASSERT_EQ(::stat("/bin/true", &program), 0);
  EXPECT_EQ(file_of(passed[3]), program.st_ino);
  for (const int descriptor : passed) ::close(descriptor);
  EXPECT_FALSE(gateway.take_end(0).has_value());
  connection.reset();
  EXPECT_TRUE(gateway.take_end(0).has_value()) << "the service has ended";
  EXPECT_FALSE(gateway.running());
  EXPECT_EQ(wait_until_due_ms(gateway, 0), 100);
}

TEST(GatewayProcess, TellsAServiceToEndAndSeesWhenItHas) {
  const ServiceSocket service;
  const WakePipe pipe;
  GatewayProcess gateway("/bin/true", {pipe.core_end(), pipe.core_end(), pipe.core_end()}, service.path());
  gateway.start(0);
  UniqueFd connection = service.accept();
  for (const int descriptor : receive_descriptors(connection.get())) ::close(descriptor);
  pollfd core{connection.get(), POLLRDHUP, 0};
  EXPECT_EQ(::poll(&core, 1, 0), 0);
  gateway.kill();
  EXPECT_EQ(::poll(&core, 1, 0), 1) << "it is asked to";
  EXPECT_FALSE(gateway.take_end(0).has_value()) << "it has not yet, and no other is started beside it";
  EXPECT_FALSE(gateway.start_due(1'000'000'000));
  connection.reset();
  EXPECT_TRUE(gateway.take_end(0).has_value());
}

TEST(GatewayProcess, WaitsWhenNoServiceManagerListens) {
  const TemporaryFolder folder;
  GatewayProcess gateway("/bin/true", {0, 1, 2}, folder.path() / "nobody");
  EXPECT_THROW(gateway.start(0), std::system_error);
  EXPECT_FALSE(gateway.running());
  EXPECT_EQ(wait_until_due_ms(gateway, 0), 100);
}

}  // namespace
}  // namespace strainwave
