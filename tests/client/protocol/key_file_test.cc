// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/key_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <strainwave/setpoint_v1.hpp>

#include "base/input_error.h"
#include "base/text_file.h"
#include "client/protocol/sender.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class KeyFile : public ::testing::Test {
 protected:
  static mode_t mode_of(const std::filesystem::path& path) {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
  }

  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  std::filesystem::path path_ = folder_ / "key";
};

TEST_F(KeyFile, IsMadeForItsOwnerAloneWhateverTheUmask) {
  const mode_t before = ::umask(0);
  const AuthorizedKey key = write_new_key(path_, Role::kEngineer, "Ann");
  ::umask(before);
  EXPECT_EQ(mode_of(path_), 0600U);
  EXPECT_EQ(read_text_file(path_.string() + ".pub"), to_line(key) + "\n");
  const SecretKeyText read = read_secret_key(path_);
  EXPECT_EQ(read.key.public_key(), key.key);
  EXPECT_EQ(read.role, Role::kEngineer);
}

TEST_F(KeyFile, NeverOverwritesAKeyOrItsPublicLine) {
  write_new_key(path_, Role::kOperator, "");
  const std::string secret = read_text_file(path_);
  EXPECT_THROW(write_new_key(path_, Role::kOperator, ""), InputError);
  EXPECT_EQ(read_text_file(path_), secret);
  std::filesystem::remove(path_.string() + ".pub");
  EXPECT_THROW(write_new_key(path_, Role::kOperator, ""), InputError);
  EXPECT_EQ(read_text_file(path_), secret);
  EXPECT_FALSE(std::filesystem::exists(path_.string() + ".pub"));
}

TEST_F(KeyFile, IsSaidToBeThePublicOneThoughThatMayBeReadByOthers) {
  write_new_key(path_, Role::kOperator, "");
  const std::string refused = testing::refusal_of([&] { read_secret_key(path_.string() + ".pub"); });
  EXPECT_NE(refused.find("this is a public key: give the file without .pub"), std::string::npos) << refused;
}

TEST_F(KeyFile, IsRefusedWhenOthersCanReadIt) {
  write_new_key(path_, Role::kOperator, "");
  for (const mode_t mode : {0640U, 0604U, 0620U}) {
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
    const std::string refused = testing::refusal_of([&] { read_secret_key(path_); });
    EXPECT_NE(refused.find("chmod 600"), std::string::npos);
  }
}

TEST_F(KeyFile, SaysWhatIsWrongWithAFileThatIsNone) {
  EXPECT_THROW(read_secret_key(folder_ / "none"), InputError);
  EXPECT_THROW(read_secret_key(folder_), InputError);
  write_new_key(path_, Role::kOperator, "");
  ASSERT_EQ(::chmod((path_.string() + ".pub").c_str(), 0600), 0);
  const std::string refused = testing::refusal_of([&] { read_secret_key(path_.string() + ".pub"); });
  EXPECT_NE(refused.find("without .pub"), std::string::npos);
}

TEST_F(KeyFile, SignsEveryOrderOfASenderButAStop) {
  const AuthorizedKey key = write_new_key(path_, Role::kOperator, "");
  Sender sender(path_);
  const SealedMessage order = sender.seal("SW.elbow.SETPOINT", setpoint_v1{}, {1, 2});
  EXPECT_TRUE(verify("SW.elbow.SETPOINT", key.key, order.bytes));
  EXPECT_TRUE(is_unsigned(sender.seal_unsigned("SW.elbow.SETPOINT", setpoint_v1{}, {1, 2}).bytes));
}

TEST_F(KeyFile, IsReadOnlyWhenSomethingMustBeSignedSoThatAStopNeverWaitsForIt) {
  Sender sender(folder_ / "none");
  EXPECT_NO_THROW(sender.seal_unsigned("SW.elbow.COMMAND", setpoint_v1{}, {1, 2}));
  EXPECT_THROW(sender.seal("SW.elbow.COMMAND", setpoint_v1{}, {1, 2}), InputError);
}

}  // namespace
}  // namespace strainwave
