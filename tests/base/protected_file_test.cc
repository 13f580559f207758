// SPDX-License-Identifier: BSD-3-Clause
#include "base/protected_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

namespace fs = std::filesystem;

class ProtectedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(root() / "a" / "b" / "c");
    std::ofstream(file()) << "x\n";
    for (const fs::path& path : {root(), root() / "a", root() / "a" / "b", root() / "a" / "b" / "c", file()})
      fs::permissions(path, fs::perms::group_write | fs::perms::others_write, fs::perm_options::remove);
  }
  void TearDown() override { fs::current_path("/"); }
  const fs::path& root() const { return folder_.path(); }
  fs::path file() const { return root() / "a" / "b" / "c" / "file"; }
  static std::string exposure(const fs::path& path, Writers allowed = Writers::kNobody) {
    return find_exposure(path, allowed).value_or("protected");
  }
  static void open_to(const fs::path& path, fs::perms perms) {
    fs::permissions(path, perms, fs::perm_options::add);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ProtectedFile, IsExposedByWhateverFolderAboveItOthersMayWrite) {
  EXPECT_EQ(exposure(file()), "protected");
  for (const fs::path& folder : {root(), root() / "a", root() / "a" / "b", root() / "a" / "b" / "c"}) {
    open_to(folder, fs::perms::others_write);
    EXPECT_EQ(exposure(file()), folder.string() + ": everyone may write it: chmod o-w " + folder.string());
    fs::permissions(folder, fs::perms::others_write, fs::perm_options::remove);
    open_to(folder, fs::perms::group_write);
    EXPECT_EQ(exposure(file()), folder.string() + ": its group may write it: chmod g-w " + folder.string());
    EXPECT_EQ(exposure(file(), Writers::kGroup), "protected");
    fs::permissions(folder, fs::perms::group_write, fs::perm_options::remove);
  }
}

TEST_F(ProtectedFile, IsNotExposedByAFolderWhereNobodyMayTouchWhatIsAnothers) {
  open_to(root() / "a", fs::perms::others_write | fs::perms::sticky_bit);
  EXPECT_EQ(exposure(file()), "protected");
}

TEST_F(ProtectedFile, IsExposedByTheFolderOfALinkAndByTheFolderThatItLeadsTo) {
  fs::create_directory(root() / "links");
  fs::create_symlink("../a/b", root() / "links" / "relative");
  fs::create_symlink(root() / "links" / "relative" / "c" / "file", root() / "links" / "absolute");
  const fs::path link = root() / "links" / "absolute";
  EXPECT_EQ(exposure(link), "protected");
  open_to(root() / "links", fs::perms::others_write);
  EXPECT_NE(exposure(link).find("/links: everyone may write it"), std::string::npos);
  fs::permissions(root() / "links", fs::perms::others_write, fs::perm_options::remove);
  open_to(root() / "a", fs::perms::others_write);
  EXPECT_NE(exposure(link).find("/a: everyone may write it"), std::string::npos);
}

TEST_F(ProtectedFile, IsExposedByTheFolderThatARelativePathIsIn) {
  fs::current_path(root() / "a" / "b");
  EXPECT_EQ(exposure("c/file"), "protected");
  EXPECT_EQ(exposure("../b/./c/file"), "protected");
  open_to(root() / "a", fs::perms::others_write);
  EXPECT_NE(exposure("c/file").find("/a: everyone may write it"), std::string::npos);
}

TEST_F(ProtectedFile, IsExposedByAFolderOrALinkOfAThirdUser) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  fs::create_symlink(file(), root() / "link");
  EXPECT_EQ(exposure(root() / "link"), "protected");
  ASSERT_EQ(::lchown((root() / "link").c_str(), 12345, 12345), 0);
  EXPECT_NE(exposure(root() / "link").find("/link: is owned by user 12345"), std::string::npos);
  ASSERT_EQ(::chown((root() / "a").c_str(), 12345, 12345), 0);
  EXPECT_NE(exposure(file()).find("/a: is owned by user 12345"), std::string::npos);
}

TEST_F(ProtectedFile, LeavesWhatDoesNotExistAndEndlessLinksToWhoeverOpensThem) {
  EXPECT_EQ(exposure(root() / "absent" / "file"), "protected");
  fs::create_symlink("loop", root() / "loop");
  EXPECT_EQ(exposure(root() / "loop"), "protected");
}

}  // namespace
}  // namespace strainwave
