// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/order_lane.h"

#include <gtest/gtest.h>

#include <strainwave/command_v1.hpp>

#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

OrderLane lane_of_command(Action action) {
  command_v1 command{};
  command.action = static_cast<std::int32_t>(action);
  return lane_of("SW", "SW.elbow.COMMAND", encode(command));
}

TEST(OrderLane, GivesDisableAndHoldTheLaneOfStopsAndNothingElse) {
  EXPECT_EQ(lane_of_command(Action::kDisable), OrderLane::kStop);
  EXPECT_EQ(lane_of_command(Action::kHold), OrderLane::kStop);
  for (const Action action : {Action::kEnable, Action::kClearFault, Action::kRevertTable, Action::kHome})
    EXPECT_EQ(lane_of_command(action), OrderLane::kOrder);
  EXPECT_EQ(lane_of("SW", "SW.elbow.COMMAND", {}), OrderLane::kOrder);
}

TEST(OrderLane, KnowsTheDaemonsChannels) {
  for (const char* channel : {"SW.elbow.SETPOINT", "SW.elbow.TABLE", "SW.elbow.PATH", "SW.a-b_c.INJECT"})
    EXPECT_EQ(lane_of("SW", channel, {}), OrderLane::kOrder) << channel;
  EXPECT_EQ(lane_of("SW", "SW.elbow.STATE", {}), OrderLane::kState);
}

TEST(OrderLane, LeavesOutEveryOtherChannel) {
  for (const char* channel :
       {"", "SW", "SW.", "SW..", "SW..COMMAND", "SW.COMMAND", "SW.elbow.", "SW.elbow.ACK",
        "SW.elbow.wrist.COMMAND", "SW2.elbow.COMMAND", "S.elbow.COMMAND", "XSW.elbow.COMMAND",
        "SW.elbow.command", "SW.TIMING", "LCM_SELF_TEST"})
    EXPECT_EQ(lane_of("SW", channel, {}), OrderLane::kNone) << channel;
}

}  // namespace
}  // namespace strainwave
