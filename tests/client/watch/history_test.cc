// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

TEST(WatchHistory, DrawsNothingWhileTheJointIsSilent) {
  JointView view;
  view.state.torque_applied_Nm = 3.0;
  view.state.joint_position_rad = 0.5;
  WatchHistory history;
  remember(view, 0.01, history);
  remember(view, 0.9, history);
  remember(view, 2.0, history);
  view.state.torque_applied_Nm = 1.0;
  remember(view, 0.01, history);
  ASSERT_EQ(history.torque_Nm.size(), 4U);
  EXPECT_EQ(history.torque_Nm[1], 3.0);
  EXPECT_EQ(history.torque_Nm[3], 1.0);
  for (const auto* values :
       {&history.torque_Nm, &history.position_rad, &history.error_rad, &history.temperature_C})
    EXPECT_TRUE(std::isnan((*values)[2])) << "nobody knows what it did";
}

TEST(WatchHistory, ForgetsTheOldest) {
  WatchHistory history;
  JointView view;
  for (int i = 0; i < 2000; ++i) {
    view.state.joint_position_rad = i;
    remember(view, 0.01, history);
  }
  EXPECT_LT(history.position_rad.size(), 1000U);
  EXPECT_EQ(history.position_rad.back(), 1999.0);
}

}  // namespace
}  // namespace strainwave
