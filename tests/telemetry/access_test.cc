// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/access.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

const std::string kToken = "0123456789abcdef";

TEST(Access, WithATokenIsForWhoShowsIt) {
  const AccessRules rules{kToken, {}};
  const auto granted = [&](const RequestFacts& request) { return judge(request, rules) == Access::kGranted; };
  EXPECT_TRUE(granted({"/metrics", "Bearer 0123456789abcdef", "", "robot:8765"}));
  EXPECT_TRUE(granted({"/metrics", "bearer 0123456789abcdef", "", "robot:8765"})) << "a scheme has no case";
  EXPECT_FALSE(granted({"/metrics", "Bearer", "", "robot:8765"}));
  EXPECT_TRUE(granted({"/?token=0123456789abcdef", "", "https://anything.example", "robot:8765"}));
  EXPECT_TRUE(granted({"/?a=b&token=0123456789abcdef&c", "", "", ""}));
  EXPECT_FALSE(granted({"/metrics", "", "", "localhost"}));
  EXPECT_FALSE(granted({"/?token=", "", "", "localhost"}));
  EXPECT_FALSE(granted({"/?token=0123456789abcdeF", "", "", ""}));
  EXPECT_FALSE(granted({"/?token=0123456789abcde", "", "", ""}));
  EXPECT_FALSE(granted({"/?token=0123456789abcdefg", "", "", ""}));
  EXPECT_FALSE(granted({"/?xtoken=0123456789abcdef", "", "", ""}));
  EXPECT_FALSE(granted({"/", "Basic 0123456789abcdef", "", ""}));
}

TEST(Access, WithoutATokenIsNotForForeignPages) {
  const AccessRules rules{"", {"https://app.foxglove.dev"}};
  const auto granted = [&](const RequestFacts& request) { return judge(request, rules) == Access::kGranted; };
  for (const char* host : {"localhost:8765", "127.0.0.1:8765", "[::1]:8765", "localhost", "127.8.0.1:1"})
    EXPECT_TRUE(granted({"/metrics", "", "", host})) << host;
  EXPECT_TRUE(granted({"/", "", "https://app.foxglove.dev", "localhost:8765"}));
  EXPECT_FALSE(granted({"/", "", "https://evil.example", "localhost:8765"}));
  EXPECT_FALSE(granted({"/", "", "null", "localhost:8765"}));
  EXPECT_TRUE(granted({"/", "", "http://localhost:8765", "localhost:8765"})) << "the page at /";
  EXPECT_FALSE(granted({"/", "", "http://localhost:8080", "localhost:8765"}))
      << "another server of this machine";
  EXPECT_FALSE(granted({"/", "", "http://evil.example:8765", "evil.example:8765"}));
  // An attacker's page maps its own host name to this machine's address (DNS rebinding).
  for (const char* host :
       {"evil.example:8765", "localhost.evil.example", "127.0.0.1.evil.example", "", "[", "10.0.0.1"})
    EXPECT_FALSE(granted({"/metrics", "", "", host})) << host;
}

TEST(ListenAddress, IsAnAddressAndAPort) {
  EXPECT_EQ(parse_listen_address("127.0.0.1:0").port, 0);
  EXPECT_EQ(parse_listen_address("[::1]:9").host, "::1");
  for (const char* text : {"", "8765", "localhost:8765", "127.0.0.1", "127.0.0.1:", "127.0.0.1:70000",
                           "127.0.0.1:-1", "127.0.0.1:8765x", "[::1]", "[::1:9", "1.2.3:9"})
    EXPECT_THROW(parse_listen_address(text), InputError) << text;
}

TEST(ListenAddress, IsLoopbackOnlyWhereNobodyElseCanConnect) {
  for (const char* host : {"127.0.0.1", "127.1.2.3", "::1"}) EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* host : {"0.0.0.0", "::", "10.0.0.1", "128.0.0.1", "::ffff:127.0.0.1", "localhost", ""})
    EXPECT_FALSE(is_loopback(host)) << host;
}

TEST(TokenFile, IsReadOnlyWhenNobodyElseCanAndTheTokenIsLong) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "token";
  const auto write = [&](const std::string& text, std::filesystem::perms perms) {
    std::ofstream(file) << text;
    std::filesystem::permissions(file, perms);
  };
  using std::filesystem::perms;
  write(kToken + "\n", perms::owner_read | perms::owner_write);
  EXPECT_EQ(read_token(file), kToken);
  write(kToken + "\n", perms::owner_read | perms::owner_write | perms::others_read);
  EXPECT_THROW(read_token(file), InputError);
  for (const char* text : {"", "\n", "short", "0123456789abcde ", "0123456789abcdef&", "0123456789abcdé0"}) {
    write(text, perms::owner_read | perms::owner_write);
    EXPECT_THROW(read_token(file), InputError) << text;
  }
  EXPECT_THROW(read_token(folder.path() / "none"), InputError);
}

TEST(Access, KnowsTheServersOwnPageByItsOriginAndByANameOfThisMachine) {
  const auto own = [](const char* origin, const char* host) {
    return is_from_own_page({"/", "", origin, host});
  };
  EXPECT_TRUE(own("http://127.0.0.1:8765", "127.0.0.1:8765"));
  EXPECT_TRUE(own("http://localhost:9000", "localhost:9000")) << "a port that ssh forwards";
  EXPECT_TRUE(own("http://[::1]:8765", "[::1]:8765"));
  EXPECT_FALSE(own("", "localhost:8765"));
  EXPECT_FALSE(own("http://localhost:8766", "localhost:8765"));
  EXPECT_FALSE(own("https://localhost:8765", "localhost:8765"));
  EXPECT_FALSE(own("null", "localhost:8765"));
  EXPECT_FALSE(own("http://evil.example:8765", "evil.example:8765"))
      << "a page that gave its name our address";
}

}  // namespace
}  // namespace strainwave
