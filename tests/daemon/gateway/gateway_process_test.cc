// The gateway's restarts, with programs that end at once or never.
#include "daemon/gateway/gateway_process.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <stdlib.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// A program that never ends by itself.
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

/// Waits for the end of the child, which takes real time; the clock of the back-off is `now_ns`.
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

// An upgrade of the package puts another file in its place while the daemon runs.
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

}  // namespace
}  // namespace strainwave
