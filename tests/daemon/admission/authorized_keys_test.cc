// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/authorized_keys.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class AuthorizedKeysFile : public ::testing::Test {
 protected:
  static AuthorizedKey some_key(Role role) { return {SecretKey::generate().public_key(), role, "someone"}; }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  std::string error() const {
    return testing::refusal_of([&] { read_authorized_keys(path_); });
  }

  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  std::filesystem::path path_ = folder_ / "authorized_keys";
};

TEST_F(AuthorizedKeysFile, IsReplacedByTheServiceManagersCredentialOfTheSameName) {
  const std::filesystem::path credentials = folder_ / "credentials";
  std::filesystem::create_directory(credentials);
  EXPECT_EQ(credential_or_file(path_), path_);
  ::setenv("CREDENTIALS_DIRECTORY", credentials.c_str(), 1);
  EXPECT_EQ(credential_or_file(path_), path_) << "there is no such credential";
  std::ofstream(credentials / "authorized_keys") << "# empty\n";
  EXPECT_EQ(credential_or_file(path_), credentials / "authorized_keys");
  EXPECT_EQ(credential_or_file(folder_ / "other_keys"), folder_ / "other_keys");
  ::unsetenv("CREDENTIALS_DIRECTORY");
}

TEST_F(AuthorizedKeysFile, ReadsKeysAndSkipsCommentsAndEmptyLines) {
  const AuthorizedKey first = some_key(Role::kOperator);
  const AuthorizedKey second = some_key(Role::kEngineer);
  write("# cell 3\n\n  \t\n" + to_line(first) + "\n  # more\n" + to_line(second));
  const AuthorizedKeys keys = read_authorized_keys(path_);
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].key, first.key);
  EXPECT_EQ(keys[1].role, Role::kEngineer);
  EXPECT_EQ(keys.find(second.key.id()), 1U);
  EXPECT_EQ(keys.find(KeyId{}), std::nullopt);
}

TEST_F(AuthorizedKeysFile, NamesFileAndLineOfADefect) {
  write("# one\n" + to_line(some_key(Role::kOperator)) + "\nnonsense\n");
  EXPECT_NE(error().find(path_.string() + ":3: a line has the form ed25519"), std::string::npos) << error();
}

TEST_F(AuthorizedKeysFile, RefusesAKeyThatStandsThereTwice) {
  AuthorizedKey key = some_key(Role::kOperator);
  const std::string operator_line = to_line(key);
  key.role = Role::kEngineer;
  write(operator_line + "\n" + to_line(key) + "\n");
  EXPECT_NE(error().find(":2: repeats the key of line 1"), std::string::npos) << error();
}

TEST_F(AuthorizedKeysFile, RefusesAFileWithoutAKeyOrWithoutReadableContent) {
  EXPECT_NE(error().find("cannot be read"), std::string::npos);
  write("# nobody yet\n");
  EXPECT_NE(error().find("keygen"), std::string::npos) << error();
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_NE(error().find("not a file"), std::string::npos) << error();
}

TEST_F(AuthorizedKeysFile, RefusesWhatItsGroupOrEveryoneMayWrite) {
  write(to_line(some_key(Role::kOperator)) + "\n");
  ASSERT_EQ(::chmod(path_.c_str(), 0646), 0);
  EXPECT_NE(error().find("chmod o-w"), std::string::npos) << error();
  ASSERT_EQ(::chmod(path_.c_str(), 0644), 0);
  EXPECT_EQ(error(), "accepted");
  ASSERT_EQ(::chmod(path_.c_str(), 0664), 0);
  EXPECT_NE(error().find("chmod g-w"), std::string::npos) << error();
  ASSERT_EQ(::chmod(path_.c_str(), 0644), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  EXPECT_NE(error().find("chmod o-w " + folder_.string()), std::string::npos) << error();
}

TEST_F(AuthorizedKeysFile, RefusesAFileOfAThirdUser) {
  write(to_line(some_key(Role::kOperator)) + "\n");
  if (::chown(path_.c_str(), 12345, 12345) != 0) GTEST_SKIP() << "only root can give a file away";
  EXPECT_NE(error().find("is owned by user 12345"), std::string::npos) << error();
}

TEST_F(AuthorizedKeysFile, BoundsTheirNumber) {
  std::string text;
  for (std::size_t i = 0; i <= AuthorizedKeys::kMaxKeys; ++i)
    text += to_line(some_key(Role::kOperator)) + "\n";
  write(text);
  EXPECT_NE(error().find("at most 256 keys"), std::string::npos) << error();
}

}  // namespace
}  // namespace strainwave
