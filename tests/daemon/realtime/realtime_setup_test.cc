#include "daemon/realtime/realtime_setup.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

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

}  // namespace
}  // namespace strainwave
