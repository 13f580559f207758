// SPDX-License-Identifier: BSD-3-Clause
// Measures the real-time thread of the running daemon under every kind of use: commands, setpoints and
// streams, table swaps, refused orders, faults and their clearing. For the virtual machine of tests/vm,
// because it needs SCHED_FIFO and strace.
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "drivers/injected_fault.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/loop_trap.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;
constexpr seconds kWatched{20};  ///< a few rounds of every kind of use

/// The counts of loop_trap.cc, which the daemon shares through a file.
class LoopTrap {
 public:
  explicit LoopTrap(const std::filesystem::path& path) {
    std::ofstream(path) << std::string(sizeof(LoopTrapCounts), '\0');
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    counts_ = static_cast<LoopTrapCounts*>(
        ::mmap(nullptr, sizeof(LoopTrapCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    ::close(file);
    ::setenv("STRAINWAVE_LOOP_TRAP", path.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  }
  const LoopTrapCounts& counts() const { return *counts_; }

 private:
  LoopTrapCounts* counts_ = nullptr;
};

class PureLoop : public DaemonTest {
 protected:
  void SetUp() override {
    if (!in_virtual_time()) GTEST_SKIP() << "for the virtual machine: ctest -L vm";
  }

  void start(const std::filesystem::path& preload = {}) {
    daemon_.emplace(folder_,
                    configuration("[recorder]\ndirectory = \"records\"\nseconds = 1\nmin_interval_s = 5\n"),
                    DaemonStart{preload, -1});
    ASSERT_TRUE(client_.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(client_.load("elbow", shipped_table()).accepted);
  }

  Answer inject(InjectedFault kind, double for_s) {
    return client_.send_and_wait(
        "elbow", "INJECT", client_.make_injection("elbow", static_cast<std::int32_t>(kind), for_s, 0.0));
  }

  void stream(double start_rad, int setpoints) {
    client_.begin_stream();
    for (int i = 0; i < setpoints; ++i) {
      setpoint_v1 setpoint = client_.make_setpoint("elbow", start_rad + 1e-3 * i, 0.05);
      setpoint.acknowledge = 0;
      client_.lcm().publish("SW.elbow.SETPOINT", &setpoint);
      client_.pump(milliseconds(10));
    }
    client_.pump(milliseconds(300));  // the stream expires, the joint holds
  }

  /// One round of every kind of use, about 6 s.
  void live_through_a_round(int round) {
    ASSERT_TRUE(client_.command("elbow", Action::kEnable).accepted) << daemon_->log();
    ASSERT_TRUE(client_.wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    const double target_rad = round % 2 == 0 ? 1.0 : -1.0;
    ASSERT_TRUE(client_.move("elbow", target_rad).accepted);
    ASSERT_FALSE(client_.load("elbow", shipped_table()).accepted) << "a table while moving";
    ASSERT_FALSE(client_.move("elbow", 99.0).accepted) << "out of range";
    ASSERT_TRUE(client_.wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    ASSERT_TRUE(client_.load("elbow", shipped_table()).accepted);
    ASSERT_TRUE(client_.command("elbow", Action::kRevertTable).accepted);
    stream(target_rad, 50);
    ASSERT_TRUE(client_.command("elbow", Action::kHold).accepted);
    constexpr InjectedFault kFaults[] = {InjectedFault::kSensorNan, InjectedFault::kPowerLost,
                                         InjectedFault::kWriteRefused};
    ASSERT_TRUE(inject(InjectedFault::kTemperatureLost, 0.5).accepted);
    ASSERT_TRUE(client_.move("elbow", 0.0).accepted);
    ASSERT_TRUE(inject(kFaults[round % 3], 0.2).accepted);
    ASSERT_TRUE(client_.wait_for_mode("elbow", Mode::kFaulted)) << daemon_->log();
    client_.pump(milliseconds(1500));
    ASSERT_TRUE(client_.command("elbow", Action::kClearFault).accepted);
    ASSERT_TRUE(client_.wait_for_mode("elbow", Mode::kOff));
  }

  /// The daemon's only task with SCHED_FIFO.
  pid_t loop_task() const {
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(daemon_->pid()) + "/task")) {
      const pid_t id = std::stoi(task.path().filename().string());
      if (::sched_getscheduler(id) == SCHED_FIFO) return id;
    }
    return -1;
  }

  std::optional<DaemonProcess> daemon_;
  TestClient client_;
};

TEST_F(PureLoop, IsWatchedByATrapThatSees) {
  LoopTrap trap(folder_ / "trap");
  const std::string watched =
      "env LD_PRELOAD=" + (programs_folder() / "loop_trap.so").string() + " sort /proc/cpuinfo >/dev/null";
  ASSERT_EQ(std::system(watched.c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
  EXPECT_EQ(trap.counts().loaded, 1);
  EXPECT_EQ(trap.counts().allocations, 0) << "of a thread without real time";
  ASSERT_EQ(std::system(("chrt -f 1 " + watched).c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
  EXPECT_GT(trap.counts().allocations, 0);
  EXPECT_GT(trap.counts().locks, 0);
}

TEST_F(PureLoop, NeitherAllocatesNorLocksNorTouchesANewPageInSecondsOfEverything) {
  LoopTrap trap(folder_ / "trap");
  start(programs_folder() / "loop_trap.so");
  ASSERT_EQ(trap.counts().loaded.load(), 1) << "the library was not loaded: nothing would be counted";
  live_through_a_round(0);
  ASSERT_TRUE(client_.wait_for_timing());
  const timing_v1 before = *client_.timing();
  const std::int64_t allocations = trap.counts().allocations;
  const std::int64_t locks = trap.counts().locks;

  const auto start_time = Clock::now();
  int rounds = 0;
  while (Clock::now() - start_time < kWatched) {
    live_through_a_round(++rounds);
    if (HasFatalFailure()) return;
  }
  ASSERT_TRUE(client_.wait_for_timing());
  const timing_v1 after = *client_.timing();
  const std::int64_t cycles = after.cycles - before.cycles;
  std::printf("%lld cycles, %d rounds: %lld allocations, %lld locks, %lld page faults, %lld overruns\n",
              static_cast<long long>(cycles), rounds,
              static_cast<long long>(trap.counts().allocations - allocations),
              static_cast<long long>(trap.counts().locks - locks),
              static_cast<long long>(after.page_faults - before.page_faults),
              static_cast<long long>(after.overruns - before.overruns));
  EXPECT_EQ(after.real_time, 1);
  EXPECT_GE(cycles, 1000 * kWatched.count());
  EXPECT_EQ(trap.counts().allocations, allocations);
  EXPECT_EQ(trap.counts().locks, locks);
  EXPECT_EQ(after.page_faults, before.page_faults);
  EXPECT_EQ(after.overruns, before.overruns);
}

TEST_F(PureLoop, CallsTheSystemOnlyToSleepAndToCountItsPageFaults) {
  start();
  const pid_t task = loop_task();
  ASSERT_GT(task, 0);
  const std::string trace_path = folder_ / "trace";
  const pid_t tracer = ::fork();
  if (tracer == 0) {
    ::execlp("strace", "strace", "-q", "-o", trace_path.c_str(), "-p", std::to_string(task).c_str(), nullptr);
    ::_exit(127);
  }
  client_.pump(milliseconds(500));
  for (int round = 0; round < 2 && !HasFatalFailure(); ++round) live_through_a_round(round);
  ::kill(tracer, SIGINT);
  ::waitpid(tracer, nullptr, 0);

  std::ifstream trace(trace_path);
  std::set<std::string> calls;
  std::int64_t count = 0;
  for (std::string line; std::getline(trace, line); ++count)
    if (const std::size_t bracket = line.find('('); bracket != std::string::npos)
      calls.insert(line.substr(0, bracket));
  std::printf("%lld system calls of the loop:", static_cast<long long>(count));
  for (const std::string& call : calls) std::printf(" %s", call.c_str());
  std::printf("\n");
  EXPECT_GT(count, 5000) << "strace saw too little";
  for (const std::string& call : calls)
    EXPECT_TRUE(call == "clock_nanosleep" || call == "getrusage" || call == "restart_syscall") << call;
}

}  // namespace
}  // namespace strainwave::testing
