// SPDX-License-Identifier: BSD-3-Clause
// The report of a wait for several joints when one of them yields to a load.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "client/protocol/joint_path.h"
#include "tests/client/commands/commands_fixture.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

/// States of a path whose wrist yields to a load. The elbow stops because of it, and its state arrives first.
struct YieldingPath {
  FakeDaemon &elbow, &wrist;
  int rounds = 0;

  void on_state(const ReceivedMessage&) {
    if (++rounds > 200) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const bool over = rounds > 20;
    if (over) wrist.show_yield();
    elbow.state.target_position_rad = over ? 0.1 : 0.4;
    wrist.state.target_position_rad = wrist.state.joint_position_rad = over ? 0.2871 : -0.2;
    wrist.state.cycle = elbow.state.cycle;
    elbow.publish_state(Mode::kTracking);
    wrist.publish_state(over ? Mode::kHolding : Mode::kTracking);
  }
};

TEST_F(CommandsTest, ALoadThatOneOfSeveralJointsYieldsToIsToldAndNotWhatItMadeOfTheOthers) {
  FakeDaemon wrist(connection, "SW", "wrist");
  const std::vector<JointPath> path{{"elbow", {{0, 0, 0}, {1, 0.4, 0}}},
                                    {"wrist", {{0, 0, 0}, {1, -0.2, 0}}}};
  daemon.publish_state(Mode::kHolding);
  wrist.publish_state(Mode::kHolding);
  YieldingPath playing{daemon, wrist};
  const Subscription states = connection.subscribe("SW\\.elbow\\.STATE", &YieldingPath::on_state, &playing);
  client.wait_for_joint("wrist");
  daemon.publish_state(Mode::kTracking);
  EXPECT_EQ(status_of([&] { (void)wait_for_path(client, path, {}); }), ExitStatus::kRefused);
  EXPECT_EQ(
      message,
      "wrist: did not arrive at -0.2 rad: it yielded to a load of 13.1 N.m (load_Nm allows 12) at 0.3011 "
      "rad; it holds at 0.2871 rad");
  EXPECT_EQ(details.joint, "wrist");
  EXPECT_TRUE(details.yielded_to);
}

/// States of a path on which each joint drives into a wall. The elbow yields first and the wrist stops with it. Only later does the wrist show that
/// it yields or faults too.
struct PathIntoTwoWalls {
  FakeDaemon &elbow, &wrist;
  Mode wrist_ends = Mode::kHolding;
  int rounds = 0;

  void on_state(const ReceivedMessage&) {
    if (++rounds > 200) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const bool over = rounds > 20, wrist_over = rounds > 30;
    if (over) elbow.show_yield();
    if (wrist_over && wrist_ends == Mode::kHolding) wrist.show_yield();
    if (wrist_ends == Mode::kFaulted) wrist.state.fault = static_cast<std::int32_t>(Fault::kOverload);
    elbow.state.target_position_rad = elbow.state.joint_position_rad = over ? 0.2871 : 0.4;
    wrist.state.target_position_rad = wrist.state.joint_position_rad = over ? -0.1 : -0.2;
    wrist.state.cycle = elbow.state.cycle;
    elbow.publish_state(over ? Mode::kHolding : Mode::kTracking);
    wrist.publish_state(wrist_over ? wrist_ends : over ? Mode::kHolding : Mode::kTracking);
  }
};

class TwoWallsTest : public CommandsTest {
 protected:
  void ride(Mode wrist_ends) {
    FakeDaemon wrist(connection, "SW", "wrist");
    const std::vector<JointPath> path{{"elbow", {{0, 0, 0}, {1, 0.4, 0}}},
                                      {"wrist", {{0, 0, 0}, {1, -0.2, 0}}}};
    daemon.publish_state(Mode::kHolding);
    wrist.publish_state(Mode::kHolding);
    PathIntoTwoWalls playing{daemon, wrist, wrist_ends};
    const Subscription states =
        connection.subscribe("SW\\.elbow\\.STATE", &PathIntoTwoWalls::on_state, &playing);
    client.wait_for_joint("wrist");
    daemon.publish_state(Mode::kTracking);
    (void)wait_for_path(client, path, {});
  }
  const std::string elbow =
      "elbow: did not arrive at 0.4 rad: it yielded to a load of 13.1 N.m (load_Nm allows 12) at 0.3011 "
      "rad; it holds at 0.2871 rad";
};

TEST_F(TwoWallsTest, TellOfEachJointThatYielded) {
  EXPECT_EQ(status_of([&] { ride(Mode::kHolding); }), ExitStatus::kRefused);
  EXPECT_EQ(message,
            elbow +
                "\nwrist: did not arrive at -0.2 rad: it yielded to a load of 13.1 N.m (load_Nm allows 12) "
                "at 0.3011 rad; it holds at -0.1 rad");
  ASSERT_EQ(details.each.size(), 2U);
  EXPECT_EQ(details.each[0].details().joint, "elbow");
  EXPECT_EQ(details.each[1].details().joint, "wrist");
  EXPECT_TRUE(details.each[1].details().yielded_to);
}

TEST_F(TwoWallsTest, TellOfTheFaultFirst) {
  EXPECT_EQ(status_of([&] { ride(Mode::kFaulted); }), ExitStatus::kRefused);
  EXPECT_EQ(message,
            "wrist: faulted (24: load too large); once the cause is gone: strainwavectl clear-fault wrist\n" +
                elbow);
  EXPECT_EQ(details.joint, "wrist");
  EXPECT_EQ(details.fault, Fault::kOverload);
  EXPECT_EQ(details.each.size(), 2U);
}

}  // namespace
}  // namespace strainwave
