// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/input_error.h"
#include "client/protocol/key_file.h"
#include "telemetry/acting.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

/// Returns the token of a page that uses this key.
std::string token_with(const std::filesystem::path& key) {
  const Fleet fleet{};
  const Acting acting(
      key, fleet, [](const auto&, const auto&) {}, [](auto, const auto&) {});
  return acting.token();
}

TEST(ActingKey, IsAnOperatorsAlone) {
  const TemporaryFolder folder;
  write_new_key(folder.path() / "operator", Role::kOperator, "bench");
  write_new_key(folder.path() / "engineer", Role::kEngineer, "bench");
  EXPECT_NO_THROW(token_with(folder.path() / "operator"));
  EXPECT_THROW(token_with(folder.path() / "engineer"), InputError);
  EXPECT_THROW(token_with(folder.path() / "absent"), InputError);
}

TEST(ActingKey, GoesWithATokenThatNoOtherStartHas) {
  const TemporaryFolder folder;
  write_new_key(folder.path() / "key", Role::kOperator, "bench");
  const std::string token = token_with(folder.path() / "key");
  EXPECT_GE(token.size(), 32U);
  EXPECT_NE(token_with(folder.path() / "key"), token);
}

}  // namespace
}  // namespace strainwave
