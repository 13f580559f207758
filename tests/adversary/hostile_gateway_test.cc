// SPDX-License-Identifier: BSD-3-Clause
// A compromised gateway runs as the same user behind the real filter. None of its attempts may harm the core. The core is this process, with the
// core's own code for memory, wake and child.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <thread>

#include "daemon/gateway/gateway_process.h"
#include "daemon/gateway/sanitized.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/gateway/wake_pipe.h"

namespace strainwave {
namespace {

enum class Outcome { kNotTried, kRefused, kEnded, kSucceeded };

struct Attempted {
  Outcome outcome;
  std::string end;  ///< how the gateway ended
};

Attempted attempt(const std::string& what, bool confined) {
  // NOLINTBEGIN(concurrency-mt-unsafe): one thread
  ::setenv("STRAINWAVE_ATTEMPT", what.c_str(), 1);
  confined ? ::unsetenv("STRAINWAVE_UNCONFINED") : ::setenv("STRAINWAVE_UNCONFINED", "1", 1);
  // NOLINTEND(concurrency-mt-unsafe)
  const MemoryFile outbound = MemoryFile::create("strainwave-outbound", sizeof(OutboundMemory), true);
  const MemoryFile inbound = MemoryFile::create("strainwave-inbound", sizeof(InboundMemory), false);
  new (outbound.address()) OutboundMemory;
  const auto& report = *new (inbound.address()) InboundMemory;
  const WakePipe wake;
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "hostile-gateway";
  GatewayProcess gateway(program, {outbound.descriptor(), inbound.descriptor(), wake.gateway_end()});
  gateway.start(0);
  for (int i = 0; i < 2000; ++i) {
    if (const auto end = gateway.take_end(0)) {
      if (report.turns.load() == 2) return {Outcome::kSucceeded, *end};
      if (report.turns.load() == 0) return {Outcome::kNotTried, *end};
      return {*end == "exit status 3" ? Outcome::kRefused : Outcome::kEnded, *end};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {Outcome::kNotTried, "it still runs"};
}

class HostileGateway : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "no filter of system calls in a sanitized build";
  }
};

std::string name_of(const ::testing::TestParamInfo<const char*>& info) {
  std::string name = info.param;
  for (char& letter : name)
    if (letter == ' ' || letter == '\'') letter = '_';
  return name;
}

class HostileGatewayAttempt : public HostileGateway {};

// Without the filter each attempt succeeds, which shows that the filter stops it.
TEST_P(HostileGatewayAttempt, IsEndedByTheFilterAndSucceedsWithoutIt) {
  const Attempted without = attempt(GetParam(), false);
  EXPECT_EQ(without.outcome, Outcome::kSucceeded) << "this is no attempt: " << without.end;
  const Attempted with = attempt(GetParam(), true);
  EXPECT_EQ(with.outcome, Outcome::kEnded) << with.end;
  EXPECT_EQ(with.end, "signal 31") << "SIGSYS";
}

INSTANTIATE_TEST_SUITE_P(Every, HostileGatewayAttempt,
                         ::testing::Values("stop the core by an asynchronous socket",
                                           "kill the core by an asynchronous socket", "signal the core",
                                           "signal the core by its descriptor", "limit the core",
                                           "leave a child behind", "make the wake block",
                                           "make the wake block by ioctl", "open a local socket",
                                           "open a TCP socket", "open a UDP socket", "open a netlink socket",
                                           "open a file", "make memory that runs", "take privileges"),
                         name_of);

class HostileGatewayIntrusion : public HostileGateway {};

// Some systems refuse these attempts for other reasons too: a missing module, or a core with capabilities that the gateway gave up.
TEST_P(HostileGatewayIntrusion, IsEndedByTheFilter) {
  const Attempted with = attempt(GetParam(), true);
  EXPECT_EQ(with.outcome, Outcome::kEnded) << with.end;
  EXPECT_EQ(with.end, "signal 31") << "SIGSYS";
}

INSTANTIATE_TEST_SUITE_P(Every, HostileGatewayIntrusion,
                         ::testing::Values("open a CAN socket", "schedule the core",
                                           "put the core behind everybody", "go before everybody",
                                           "move the core to another processor", "trace the core",
                                           "write the core's memory", "start a program",
                                           "shrink the shared memory", "write the shared file"),
                         name_of);

class HostileGatewayMapping : public HostileGateway {};

// The filter allows these calls. The seal on the core's memory refuses them with or without the filter.
TEST_P(HostileGatewayMapping, IsRefusedWithTheFilterAndWithout) {
  for (const bool confined : {true, false}) {
    const Attempted tried = attempt(GetParam(), confined);
    EXPECT_EQ(tried.outcome, Outcome::kRefused) << tried.end;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, HostileGatewayMapping,
                         ::testing::Values("make the core's shared memory writable",
                                           "map the core's shared memory writable"),
                         name_of);

}  // namespace
}  // namespace strainwave
