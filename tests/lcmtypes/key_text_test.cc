// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/key_text.h"

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

SecretKeyText some_key() {
  return {SecretKey::generate(), Role::kEngineer, "Ann, cell 3"};
}

std::string error_of(const std::string& line) {
  return testing::refusal_of([&] { parse_public_line(line); });
}

TEST(KeyText, ReadsWhatItWrites) {
  const SecretKeyText secret = some_key();
  const AuthorizedKey key{secret.key.public_key(), Role::kEngineer, "Ann, cell 3"};
  const AuthorizedKey read = parse_public_line(to_line(key));
  EXPECT_EQ(read.key, key.key);
  EXPECT_EQ(read.role, Role::kEngineer);
  EXPECT_EQ(read.comment, "Ann, cell 3");
  const SecretKeyText read_secret = parse_secret_line(to_line(secret));
  EXPECT_EQ(read_secret.key.seed(), secret.key.seed());
  EXPECT_EQ(read_secret.role, Role::kEngineer);
  EXPECT_EQ(read_secret.comment, "Ann, cell 3");
}

TEST(KeyText, TakesTabsAndSeveralSpacesAndNoComment) {
  const AuthorizedKey key{some_key().key.public_key(), Role::kOperator, ""};
  std::string line = to_line(key);
  line.replace(line.find(' '), 1, " \t  ");
  EXPECT_EQ(parse_public_line("  " + line + "  ").key, key.key);
  EXPECT_EQ(parse_public_line(line).comment, "");
}

TEST(KeyText, SaysWhatIsWrongWithALine) {
  const std::string sound = to_line(AuthorizedKey{some_key().key.public_key(), Role::kOperator, "x"});
  const std::string key = sound.substr(8, 44);
  EXPECT_NE(error_of("ssh-ed25519 " + key + " operator").find("has the form"), std::string::npos);
  EXPECT_NE(error_of("ed25519").find("44 characters"), std::string::npos);
  EXPECT_NE(error_of("ed25519 " + key.substr(1) + " operator").find("44 characters"), std::string::npos);
  EXPECT_NE(error_of("ed25519 " + key + "A operator").find("44 characters"), std::string::npos);
  EXPECT_NE(error_of("ed25519 " + key).find("operator or engineer"), std::string::npos);
  EXPECT_NE(error_of("ed25519 " + key + " Engineer").find("operator or engineer"), std::string::npos);
  EXPECT_NE(error_of(sound + "\r").find("Windows line end"), std::string::npos);
  EXPECT_NE(error_of(sound + std::string(101, 'x')).find("100 bytes"), std::string::npos);
  EXPECT_NE(error_of("ed25519 AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA= operator")
                .find("not an Ed25519 public key"),
            std::string::npos);
}

TEST(KeyText, WarnsOfASecretKeyAmongPublicOnesWithoutQuotingIt) {
  const SecretKeyText secret = some_key();
  const std::string line = to_line(secret);
  const std::string error = error_of(line);
  EXPECT_NE(error.find("secret key"), std::string::npos);
  EXPECT_EQ(error.find(line.substr(15, 20)), std::string::npos);
}

TEST(KeyText, RefusesAPublicKeyWhereASecretOneIsNeeded) {
  EXPECT_THROW(parse_secret_line(to_line(AuthorizedKey{some_key().key.public_key(), Role::kOperator, ""})),
               InputError);
  EXPECT_THROW(parse_secret_line(""), InputError);
  EXPECT_THROW(parse_secret_line("-----BEGIN OPENSSH PRIVATE KEY-----"), InputError);
}

}  // namespace
}  // namespace strainwave
