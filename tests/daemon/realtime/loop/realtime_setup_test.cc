// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/realtime_setup.h"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/input_error.h"
#include "daemon/start_check.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

namespace fs = std::filesystem;

bool held_open(const fs::path& file) {
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    if (fs::read_symlink(entry.path(), gone) == file) return true;
  }
  return false;
}

TEST(RealtimeSetup, SwitchesTransparentHugePagesOff) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const bool before = ::prctl(PR_GET_THP_DISABLE, 0, 0, 0, 0) == 1;
        lock_memory();
        ::_exit(!before && ::prctl(PR_GET_THP_DISABLE, 0, 0, 0, 0) == 1 ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(RealtimeSetup, WarnsOfAKernelThatMovesLockedMemoryAndOfNoOther) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "setting";
  EXPECT_EQ(compaction_warning(path), "");
  std::ofstream(path) << "0\n";
  EXPECT_EQ(compaction_warning(path), "");
  std::ofstream(path) << "1\n";
  EXPECT_NE(compaction_warning(path).find("compact_unevictable_allowed=0"), std::string::npos);
}

TEST(RealtimeSetup, AsksForNoWakeUpLatencyAsLongAsItsFileIsOpenAndNoLonger) {
  const TemporaryFolder folder;
  const fs::path file = fs::canonical(folder.path()) / "cpu_dma_latency";
  std::string refusal;
  EXPECT_FALSE(avoid_sleep_states(refusal, file));
  EXPECT_EQ(refusal, "") << "no such file: nothing to ask for";
  EXPECT_FALSE(fs::exists(file));
  std::ofstream(file) << "";
  {
    const UniqueFd awake = avoid_sleep_states(refusal, file);
    EXPECT_EQ(refusal, "");
    EXPECT_TRUE(held_open(file)) << "the kernel forgets the wish when the file is closed";
    std::int32_t wanted_us = -1;
    std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&wanted_us), sizeof wanted_us);
    EXPECT_EQ(wanted_us, 0);
  }
  EXPECT_FALSE(held_open(file));
  EXPECT_FALSE(avoid_sleep_states(refusal, folder.path()));
  EXPECT_NE(refusal.find(folder.path().string()), std::string::npos) << "a folder cannot be written";
}

[[noreturn]] void ask_as_root_without_capabilities() {
  const rlimit none{0, 0};
  (void)::setrlimit(RLIMIT_RTPRIO, &none);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> no_capabilities{};
  if (::syscall(SYS_capset, &header, no_capabilities.data()) != 0) ::_exit(2);
  const std::string refusal = make_thread_real_time(80, -1);
  ::_exit(refusal.find("needs CAP_SYS_NICE or RLIMIT_RTPRIO of 80") != std::string::npos ? 0 : 1);
}

TEST(RealtimeSetup, TellsRootWithoutCapabilitiesWhichOneItNeeds) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_as_root_without_capabilities(), ::testing::ExitedWithCode(0), "");
}

TEST(RealtimeSetup, SaysWhichProcessorsThereAreAndChangesNothing) {
  cpu_set_t before;
  ASSERT_EQ(::sched_getaffinity(0, sizeof before, &before), 0);
  const std::string problem = processor_problem(CPU_SETSIZE - 1);
  EXPECT_NE(problem.find("daemon.cpu = 1023"), std::string::npos) << problem;
  EXPECT_NE(problem.find("this process may use "), std::string::npos) << problem;
  EXPECT_EQ(problem.find("use ;"), std::string::npos) << problem;
  EXPECT_EQ(processor_problem(-1), "");
  int usable = 0;
  while (!CPU_ISSET(static_cast<std::size_t>(usable), &before)) ++usable;
  EXPECT_EQ(processor_problem(usable), "");
  cpu_set_t after;
  ASSERT_EQ(::sched_getaffinity(0, sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

TEST(StartCheck, ReportsACpusetWithoutTheConfiguredProcessor) {
  DaemonConfig config;
  config.loop.cpu = CPU_SETSIZE - 1;
  std::ostringstream out;
  try {
    check_start(config, out);
  } catch (const InputError&) {  // the gateway's program is beside the daemon, not here
  }
  EXPECT_NE(out.str().find("warning: daemon.cpu = 1023"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace strainwave
