// What who waits for several joints is told when one of them yields to a load.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "client/link/joint_path.h"
#include "tests/client/commands/commands_fixture.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

/// States of a path whose wrist yields to a load: the elbow, which stops for that, is heard of first.
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

}  // namespace
}  // namespace strainwave
