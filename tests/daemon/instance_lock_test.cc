// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/instance_lock.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class InstanceLockTest : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("RUNTIME_DIRECTORY", folder_.c_str(), 1); }
  void TearDown() override { ::unsetenv("RUNTIME_DIRECTORY"); }
  static std::string error_of(const std::string& name) {
    return testing::refusal_of([&] { const InstanceLock lock(name, "stop that one"); });
  }

  TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path() / "run";
};

TEST_F(InstanceLockTest, IsHeldByOneAtATimeAndFreeWhenItsHolderIsGone) {
  {
    const InstanceLock held("prefix SW", "");
    EXPECT_NE(error_of("prefix SW").find("stop that one"), std::string::npos);
    EXPECT_EQ(error_of("prefix arm"), "accepted");
  }
  EXPECT_EQ(error_of("prefix SW"), "accepted");
}

TEST_F(InstanceLockTest, CanBeNamedAsAnyDriveIs) {
  const InstanceLock held("drive can0 node 3/../../x", "");
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_EQ(entry.path().filename().string().find("drive-can0-node-3"), 0U) << entry.path();
}

TEST_F(InstanceLockTest, CannotBeKeptByAnAbstractAddressThatAnyUserMayBind) {
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::string name = "strainwave/prefix SW";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  (void)::bind(socket, reinterpret_cast<const sockaddr*>(&address), length);
  EXPECT_EQ(error_of("prefix SW"), "accepted");
  ::close(socket);
}

TEST_F(InstanceLockTest, WantsADirectoryThatNobodyElseCanWrite) {
  std::filesystem::create_directory(folder_);
  for (const mode_t mode : {0777U, 0775U, 01777U}) {
    ASSERT_EQ(::chmod(folder_.c_str(), mode), 0);
    EXPECT_NE(error_of("prefix SW").find("other users may write"), std::string::npos) << mode;
  }
  ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
  EXPECT_EQ(error_of("prefix SW"), "accepted");
}

TEST_F(InstanceLockTest, FollowsNoLinkToAnotherPlace) {
  std::filesystem::create_directory(temporary_.path() / "elsewhere");
  std::filesystem::create_directory_symlink(temporary_.path() / "elsewhere", folder_);
  EXPECT_NE(error_of("prefix SW").find("not a directory"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
