// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/state_view.h"

#include <gtest/gtest.h>

#include <strainwave/temperature_v1.hpp>

#include "lcmtypes/wire.h"

namespace strainwave {
namespace {

class StateViewTest : public ::testing::Test {
 protected:
  void hear(const std::string& channel, std::int64_t session_id) {
    state_v1 state{};
    state.session_id = session_id;
    view.accept(channel, encode(state));
  }

  Connection connection{"memq://"};
  StateView view{connection};
};

TEST_F(StateViewTest, KeepsTheLatestStateOfEachJoint) {
  hear("SW.elbow.STATE", 1);
  hear("SW.wrist.STATE", 1);
  state_v1 state{};
  state.joint_position_rad = 0.5;
  view.accept("SW.elbow.STATE", encode(state));
  ASSERT_NE(view.find("SW", "elbow"), nullptr);
  EXPECT_EQ(view.find("SW", "elbow")->state.joint_position_rad, 0.5);
  EXPECT_EQ(view.find("SW", "elbow")->messages, 2);
  EXPECT_EQ(view.find("SW", "hip"), nullptr);
  EXPECT_EQ(view.find("XY", "elbow"), nullptr);
}

TEST_F(StateViewTest, ListsPrefixesAndTheirJointsInOrder) {
  for (const char* channel : {"ZZ.hip.STATE", "AA.wrist.STATE", "AA.elbow.STATE"}) hear(channel, 1);
  EXPECT_EQ(view.prefixes(), (std::vector<std::string>{"AA", "ZZ"}));
  EXPECT_EQ(view.joints("AA"), (std::vector<std::string>{"elbow", "wrist"}));
  EXPECT_TRUE(view.joints("BB").empty());
}

TEST_F(StateViewTest, IgnoresWhatIsNoStateMessage) {
  const std::vector<std::uint8_t> good = encode(state_v1{});
  std::vector<std::uint8_t> shorter(good.begin(), good.end() - 1);
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  std::vector<std::uint8_t> other_type = good;
  other_type.at(0) ^= 1;
  for (const auto& bytes :
       {shorter, longer, other_type, encode(temperature_v1{}), std::vector<std::uint8_t>{}}) {
    view.accept("SW.elbow.STATE", bytes);
  }
  for (const char* channel :
       {"SW.elbow.ACK", "SW.STATE", "elbow", "SW.el bow.STATE", "SW..STATE", "..", ""}) {
    view.accept(channel, good);
  }
  EXPECT_TRUE(view.prefixes().empty());
}

TEST_F(StateViewTest, DoesNotGrowWithoutBound) {
  for (std::size_t i = 0; i < 2 * StateView::kMaxJoints; ++i) hear("SW.j" + std::to_string(i) + ".STATE", 1);
  EXPECT_EQ(view.joints("SW").size(), StateView::kMaxJoints);
  hear("SW.j0.STATE", 9);
  EXPECT_EQ(view.find("SW", "j0")->state.session_id, 9);
}

TEST_F(StateViewTest, ShowsARealDaemonWhoeverHasMadeUpNamesBeforeAndGoesOnDoingSo) {
  const LcmSource daemon{0x0A000002, 40000};
  for (const LcmSource& flooder : {LcmSource{0x0A000003, 40000}, LcmSource{0x0A000002, 50000}}) {
    StateView crowd(connection);
    const std::vector<std::uint8_t> state = encode(state_v1{});
    const auto flood = [&](const std::string& first) {
      for (int i = 0; i < 3000; ++i)
        crowd.accept("SW." + first + std::to_string(i) + ".STATE", state, flooder);
    };
    flood("a");
    for (int k = 0; k < 64; ++k) crowd.accept("SW.joint" + std::to_string(k) + ".STATE", state, daemon);
    flood("b");
    for (int k = 0; k < 64; ++k) EXPECT_NE(crowd.find("SW", "joint" + std::to_string(k)), nullptr) << k;
    EXPECT_EQ(crowd.joints("SW").size(), StateView::kMaxJoints);
  }
}

TEST_F(StateViewTest, WhatIsKeptLosesItsPlaceToNobodyEvenIfTheCrowdsSourceNamedItFirst) {
  hear("SW.elbow.STATE", 7);
  view.keep("SW", "elbow");
  const JointView* const elbow = view.find("SW", "elbow");
  for (std::size_t i = 0; i < 3 * StateView::kMaxJoints; ++i) hear("SW.j" + std::to_string(i) + ".STATE", 1);
  EXPECT_EQ(view.find("SW", "elbow"), elbow);
  EXPECT_EQ(elbow->state.session_id, 7);
}

TEST_F(StateViewTest, TellsARestartedDaemonFromTwoDaemons) {
  for (const std::int64_t session_id : {1, 1, 2, 2, 3}) hear("SW.elbow.STATE", session_id);
  EXPECT_FALSE(view.find("SW", "elbow")->two_daemons);
  for (const std::int64_t session_id : {1, 2, 1}) hear("SW.wrist.STATE", session_id);
  EXPECT_TRUE(view.find("SW", "wrist")->two_daemons);
}

TEST_F(StateViewTest, HearsItsSubscription) {
  connection.publish("SW.elbow.STATE", encode(state_v1{}));
  EXPECT_TRUE(connection.handle(1000));
  EXPECT_NE(view.find("SW", "elbow"), nullptr);
}

}  // namespace
}  // namespace strainwave
