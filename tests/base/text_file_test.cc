// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/input_error.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class TextFile : public ::testing::Test {
 protected:
  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

TEST_F(TextFile, ReadsBackWhatWasWritten) {
  const std::string text("line\n\0with zero\n", 16);
  write_text_file(folder_ / "a", text);
  EXPECT_EQ(read_text_file(folder_ / "a"), text);
  write_text_file(folder_ / "a", "short");
  EXPECT_EQ(read_text_file(folder_ / "a"), "short");
}

// The process's limit on file sizes simulates a full disk. A disk quota would not bind root.
TEST_F(TextFile, ThatDoesNotFitIsNotTheUsersMistake) {
  write_text_file(folder_ / "a", "kept");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{64, before.rlim_max};
  ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_text_file(folder_ / "a", std::string(1000, 'x')), NotAchieved);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(read_text_file(folder_ / "a"), "kept");
  try {
    write_text_file(folder_ / "missing" / "a", "text");
    FAIL() << "there is no such folder";
  } catch (const NotAchieved&) {
    FAIL() << "a wrong name is the user's";
  } catch (const InputError&) {
  }
}

TEST_F(TextFile, LeavesNoTemporaryFiles) {
  write_text_file(folder_ / "a", "text");
  EXPECT_THROW(write_text_file(folder_ / "missing" / "a", "text"), InputError);
  EXPECT_EQ(
      std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()), 1);
}

TEST_F(TextFile, AFailedReplacementKeepsTheOldFileAndCleansUp) {
  // A file cannot replace a folder that is not empty.
  std::filesystem::create_directories(folder_ / "target" / "inner");
  EXPECT_THROW(write_text_file(folder_ / "target", "text"), InputError);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "target" / "inner"));
  EXPECT_EQ(
      std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()), 1);
}

TEST_F(TextFile, WritesWhatALinkLeadsToAndKeepsTheLink) {
  namespace fs = std::filesystem;
  fs::create_directory(folder_ / "inner");
  write_text_file(folder_ / "inner" / "file", "old");
  fs::create_symlink("inner/file", folder_ / "first");
  fs::create_symlink(folder_ / "first", folder_ / "second");
  fs::create_symlink("inner/new", folder_ / "dangling");
  write_text_file(folder_ / "second", "new");
  write_text_file(folder_ / "dangling", "made");
  EXPECT_TRUE(fs::is_symlink(folder_ / "first") && fs::is_symlink(folder_ / "second") &&
              fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(read_text_file(folder_ / "inner" / "file"), "new");
  EXPECT_EQ(read_text_file(folder_ / "inner" / "new"), "made");
}

TEST_F(TextFile, IsNotWrittenOverALinkToAFolderOrThatGoesRound) {
  namespace fs = std::filesystem;
  fs::create_directory(folder_ / "inner");
  fs::create_directory_symlink("inner", folder_ / "to_folder");
  fs::create_symlink("round", folder_ / "round");
  for (const char* name : {"to_folder", "round", "inner"}) {
    EXPECT_THROW(write_text_file(folder_ / name, "text"), InputError) << name;
    EXPECT_TRUE(fs::is_symlink(folder_ / name) || fs::is_directory(folder_ / name)) << name;
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "to_folder"));
}

TEST_F(TextFile, WaitsForNoPipeAndReadsNoDeviceWithoutAnEnd) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_text_file(folder_ / "pipe"), InputError);
  EXPECT_THROW(read_text_file("/dev/zero"), InputError);
}

TEST_F(TextFile, MissingFilesAndFoldersAreNamed) {
  for (const auto& path : {folder_ / "none", folder_}) {
    const std::string refused = testing::refusal_of([&] { read_text_file(path); });
    EXPECT_NE(refused.find(path.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace strainwave
