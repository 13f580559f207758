// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/load_limits.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(UsualLoadLimit, FollowsTheTorqueThatThereIs) {
  const UsualLoad usual{4.0, 10.0, 0.0};
  EXPECT_NEAR(usual.limit_Nm(34.0), 20.0, 1e-12);
  EXPECT_NEAR(usual.limit_Nm(20.0), 0.5 * 16.0, 1e-12);
  EXPECT_NEAR(usual.limit_Nm(100.0), 0.8 * 96.0, 1e-12);
  EXPECT_NEAR(usual.limit_Nm(3.0), 0.3, 1e-12) << "less torque than the joint weighs";
  EXPECT_NEAR((UsualLoad{4.0, 10.0, 8.0}.limit_Nm(20.0)), 10.0, 1e-12) << "a quarter above what it is told";
}

TEST(UsualLoadLimit, IsNotThatOfAJointThatIsGivenOne) {
  LoadLimitConfig config;
  config.usual.accelerating_Nm = 10.0;
  EXPECT_NEAR(config.under(34.0).load_Nm, 24.0, 1e-12);
  EXPECT_NEAR(config.under(34.0).notice_Nm, 0.8 * 24.0, 1e-12);
  config.notice_Nm = 15.0;
  EXPECT_EQ(config.under(34.0).notice_Nm, 15.0);
  EXPECT_EQ(config.under(20.0).notice_Nm, 10.0) << "no later than the joint yields";
  config.load_Nm = 30.0;
  EXPECT_EQ(config.under(20.0).load_Nm, 30.0);
  EXPECT_EQ(config.under(20.0).notice_Nm, 15.0);
}

}  // namespace
}  // namespace strainwave
