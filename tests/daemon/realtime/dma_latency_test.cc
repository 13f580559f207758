// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/dma_latency.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

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

class DmaLatencyTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path file_ = fs::canonical(folder_.path()) / "cpu_dma_latency";
};

TEST_F(DmaLatencyTest, AsksForNoLatencyAsLongAsItLivesAndNoLonger) {
  std::ofstream(file_) << "";
  std::optional<DmaLatency> latency(std::in_place);
  EXPECT_EQ(latency->request(file_), "");
  EXPECT_TRUE(held_open(file_)) << "the kernel forgets the wish when the file is closed";
  std::int32_t wanted_us = -1;
  std::ifstream(file_, std::ios::binary).read(reinterpret_cast<char*>(&wanted_us), sizeof wanted_us);
  EXPECT_EQ(wanted_us, 0);
  latency.reset();
  EXPECT_FALSE(held_open(file_));
}

TEST_F(DmaLatencyTest, HasNothingToAskForWhereThereIsNoSuchFile) {
  DmaLatency latency;
  EXPECT_EQ(latency.request(file_), "");
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(DmaLatencyTest, NamesTheFileThatItMayNotWrite) {
  fs::create_directory(file_);
  DmaLatency latency;
  EXPECT_NE(latency.request(file_).find(file_.string()), std::string::npos);
}

}  // namespace
}  // namespace strainwave
