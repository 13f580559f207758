// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/multicast_check.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(MulticastAddress, IsReadFromAnLcmUrl) {
  const auto address = parse_udpm_url("udpm://239.1.2.3:4567?ttl=1");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->group, "239.1.2.3");
  EXPECT_EQ(address->port, 4567);
}

TEST(MulticastAddress, HasLcmsDefaultsForWhatIsLeftOut) {
  for (const char* url : {"udpm://", "udpm://?ttl=0", "udpm://239.255.76.67", "udpm://:7667"}) {
    const auto address = parse_udpm_url(url);
    ASSERT_TRUE(address) << url;
    EXPECT_EQ(address->group, "239.255.76.67") << url;
    EXPECT_EQ(address->port, 7667) << url;
  }
}

TEST(MulticastAddress, HasLcmsTimeToLiveWhichIsZeroUnlessItIsGiven) {
  EXPECT_EQ(parse_udpm_url("udpm://239.255.76.67:7667?ttl=1")->ttl, 1);
  EXPECT_EQ(parse_udpm_url("udpm://239.255.76.67:7667?recv_buf_size=5&ttl=2")->ttl, 2);
  for (const char* url : {"udpm://", "udpm://239.255.76.67:7667?ttl=0", "udpm://239.255.76.67:7667?xttl=1"})
    EXPECT_EQ(parse_udpm_url(url)->ttl, 0) << url;
}

TEST(MulticastAddress, IsNoneForAnotherKindOfUrl) {
  for (const char* url : {"memq://", "file:///tmp/a", "", "udpm:/", "239.255.76.67:7667"}) {
    EXPECT_FALSE(parse_udpm_url(url)) << url;
  }
}

TEST(MulticastProblem, IsNoneWhereLcmDoesNotUseMulticast) {
  EXPECT_FALSE(find_multicast_problem("memq://"));
}

TEST(MulticastProblem, NamesAGroupOrPortThatIsNone) {
  EXPECT_NE(find_multicast_problem("udpm://10.0.0.1:7667").value_or("").find("'10.0.0.1'"),
            std::string::npos);
  EXPECT_NE(find_multicast_problem("udpm://host:7667").value_or("").find("'host'"), std::string::npos);
  for (const char* url : {"udpm://239.255.76.67:0", "udpm://239.255.76.67:x", "udpm://239.255.76.67:70000"}) {
    EXPECT_NE(find_multicast_problem(url).value_or("").find("port"), std::string::npos) << url;
  }
}

}  // namespace
}  // namespace strainwave
