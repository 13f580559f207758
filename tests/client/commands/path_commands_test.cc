// SPDX-License-Identifier: BSD-3-Clause
// Paths from a file, and moves of several joints.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <strainwave/command_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <thread>

#include "lcmtypes/wire.h"
#include "tests/client/commands/commands_fixture.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class PathCommandsTest : public testing::CommandsTest {
 protected:
  std::filesystem::path file_of(const std::string& text) {
    std::ofstream(folder.path() / "path.csv") << text;
    return folder.path() / "path.csv";
  }
  std::string refusal(const std::string& text) {
    return testing::refusal_of([&] { (void)read_path(file_of(text)); });
  }
  /// Both joints hold. The client receives their states and limits as soon as it listens.
  void let_two_joints_hold() {
    for (FakeDaemon* const one : {&daemon, &wrist}) {
      one->limits.acceleration_rad_s2 = one->limits.deceleration_rad_s2 = 20.0;
      one->limits.torque_limit_Nm = 30.0;
      one->limits.inertia_kgm2 = 0.5;
      one->publish_state(Mode::kHolding);
    }
  }
  /// Publishes the limits with every state. The real daemon publishes them once a second.
  ExitStatus move_both(const MoveTogetherArguments& arguments) {
    let_two_joints_hold();
    const Subscription whenever_asked =
        connection.subscribe("SW\\.[^.]+\\.STATE", &PathCommandsTest::on_state, this);
    for (FakeDaemon* const one : {&daemon, &wrist}) one->publish_state(Mode::kHolding);
    return status_of([&] { move_together(client, output, arguments); });
  }
  void on_state(const ReceivedMessage&) {
    daemon.publish_limits();
    wrist.publish_limits();
  }
  path_v1 part(const FakeDaemon& of, std::size_t order) {
    return decode_exactly<path_v1>(of.heard().at(order).bytes).value_or(path_v1{});
  }

  FakeDaemon wrist{connection, "SW", "wrist"};
  TemporaryFolder folder;
};

constexpr const char* kTwoJoints =
    "joint,time_s,position_rad,velocity_rad_s\n"
    "elbow,0,0,0\nelbow,0.5,0.2,0.6\nwrist,0,0,0\nelbow,1,0.4,0\nwrist,1,-0.2,0\n";

TEST_F(PathCommandsTest, AFilesRowsMayStandInAnyOrderOfTheJoints) {
  const std::vector<JointPath> path = read_path(file_of(kTwoJoints));
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(path[0].joint, "elbow");
  ASSERT_EQ(path[0].knots.size(), 3U);
  EXPECT_EQ(path[0].knots[1].velocity_rad_s, 0.6);
  EXPECT_EQ(path[1].joint, "wrist");
  EXPECT_EQ(path[1].knots.back().position_rad, -0.2);
}

TEST_F(PathCommandsTest, WhatIsWrongInAFileIsNamedWithItsPlace) {
  const std::string header = "joint,time_s,position_rad,velocity_rad_s\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {header + "elbow,0,0,0\n", "path.csv: elbow: 1 knot: 2 to 320 are allowed"},
      {header + "el bow,0,0,0\n", "path.csv:2: joint = el bow: 1 to 24 characters"},
      {header + "elbow,0,0,0\nelbow,1,half,0\n", "path.csv:3: position_rad = \"half\""},
      {header + "elbow,0,0,0\nelbow,1,nan,0\n", "path.csv:3: position_rad = \"nan\""},
      {header + "elbow,0,0\n", "path.csv:2"},
      {"joint,time,position,velocity\nelbow,0,0,0\n", "time_s"}};
  for (const auto& [text, words] : cases) {
    const std::string refused = refusal(text);
    EXPECT_NE(refused.find(words), std::string::npos) << refused;
  }
  std::string many = header;
  for (int i = 0; i < 321; ++i) many += "elbow," + std::to_string(i) + ",0,0\n";
  EXPECT_NE(refusal(many).find("elbow: 321 knots: 2 to 320"), std::string::npos);
}

TEST_F(PathCommandsTest, EveryJointGetsItsPartOfOnePathBeforeItStarts) {
  let_two_joints_hold();
  EXPECT_EQ(status_of([&] {
              follow_path(client, output, {file_of(kTwoJoints), false});
            }),
            ExitStatus::kDone)
      << message;
  ASSERT_EQ(daemon.heard().size(), 2U);
  ASSERT_EQ(wrist.heard().size(), 1U);
  EXPECT_NE(part(daemon, 0).path_id, 0);
  EXPECT_EQ(part(daemon, 0).path_id, part(wrist, 0).path_id);
  EXPECT_EQ(part(daemon, 0).joint_count, 2);
  EXPECT_EQ(part(daemon, 0).knot_count, 3);
  EXPECT_EQ(part(wrist, 0).knot_count, 2);
  EXPECT_EQ(decode_exactly<command_v1>(daemon.heard()[1].bytes)->action,
            static_cast<std::int32_t>(Action::kResume));
  EXPECT_TRUE(output_has("elbow, wrist: on a path of 1.000 s")) << stream.str();
}

TEST_F(PathCommandsTest, APartThatIsRefusedStartsNothingAndIsToldInTheDaemonsWords) {
  let_two_joints_hold();
  wrist.reason = Reason::kOutOfRange;
  wrist.text = "wrist, knot 1 (at 0.5 s): speed in rad/s = 9: at most 6 is allowed";
  EXPECT_EQ(status_of([&] {
              follow_path(client, output, {file_of(kTwoJoints), false});
            }),
            ExitStatus::kRefused);
  EXPECT_TRUE(message_has("wrist: its part of the path refused (3, out of range): wrist, knot 1 (at 0.5 s)"))
      << message;
  EXPECT_EQ(daemon.heard().size(), 1U);
}

TEST_F(PathCommandsTest, JointsThatMoveTogetherEndAtTheSameTimeWithinTheirLimits) {
  EXPECT_EQ(move_both({{{"elbow", 1.0}, {"wrist", -0.5}}, false, 1.2}), ExitStatus::kDone) << message;
  const path_v1 one = part(daemon, 0);
  const path_v1 other = part(wrist, 0);
  ASSERT_EQ(one.knot_count, 4);
  ASSERT_EQ(other.knot_count, 4);
  EXPECT_EQ(one.position_rad[3], 1.0);
  EXPECT_EQ(other.position_rad[3], -0.5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(one.time_s[i], other.time_s[i]) << i;
  EXPECT_DOUBLE_EQ(one.velocity_rad_s[1], 1.2);
  EXPECT_DOUBLE_EQ(other.velocity_rad_s[1], -0.6);
}

TEST_F(PathCommandsTest, JointsThatMoveTogetherAreCalmWhereNoSpeedIsNamed) {
  EXPECT_EQ(move_both({{{"elbow", 1.0}, {"wrist", -0.5}}}), ExitStatus::kDone) << message;
  EXPECT_DOUBLE_EQ(part(daemon, 0).velocity_rad_s[1], 0.25 * 2.0);
}

TEST_F(PathCommandsTest, ATargetOutOfRangeIsRefusedBeforeAnythingIsSent) {
  EXPECT_EQ(move_both({{{"elbow", 0.5}, {"wrist", 90.0}}}), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("wrist: position_rad = 90: from -3 to 3 is allowed")) << message;
  EXPECT_TRUE(message_has("90 degrees would be 1.5708")) << message;
  EXPECT_TRUE(daemon.heard().empty() && wrist.heard().empty());
}

TEST_F(PathCommandsTest, ASpeedBeyondOneJointsLimitIsRefusedAndNamesThatJoint) {
  wrist.limits.speed_limit_rad_s = 1.0;
  EXPECT_EQ(move_both({{{"elbow", 1.0}, {"wrist", -0.5}}, false, 2.0}), ExitStatus::kUsage);
  EXPECT_EQ(message,
            "wrist: speed_limit_rad_s = 2: at most 1 is allowed (joint.limits.speed_limit_rad_s of wrist)");
}

TEST_F(PathCommandsTest, WhatIsWrongWithOneOfSeveralJointsIsSaidOfThatJoint) {
  try {
    check_path({{"elbow", {{0, 0, 0}, {1, 0.1, 0}}}, {"wrist", {{0, 0, 0}}}});
    ADD_FAILURE() << "a path of one knot was taken";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.details().joint, "wrist");
  }
}

TEST_F(PathCommandsTest, ASpeedThatTakesTooLongIsRefusedWithTheLeastThatIsAllowed) {
  EXPECT_EQ(move_both({{{"elbow", 1.0}, {"wrist", -0.5}}, false, 1e-9}), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("elbow: speed_limit_rad_s = 1e-09: at least 0.000281 is allowed")) << message;
  EXPECT_TRUE(daemon.heard().empty() && wrist.heard().empty());
}

TEST_F(PathCommandsTest, ASpeedThatTakesJustNotTooLongIsAllowed) {
  EXPECT_EQ(move_both({{{"elbow", 1.0}, {"wrist", -0.5}}, false, 0.000281}), ExitStatus::kDone) << message;
}

TEST_F(PathCommandsTest, JsonNamesTheJointsAsAList) {
  let_two_joints_hold();
  const Output json{stream, false, true};
  follow_path(client, json, {file_of(kTwoJoints), false});
  EXPECT_EQ(stream.str(), "{\"joints\":[\"elbow\",\"wrist\"],\"path_s\":1.0,\"arrived\":false}\n");
}

TEST_F(PathCommandsTest, WaitsUntilTheLastJointIsThere) {
  let_two_joints_hold();
  int rounds = 0;
  daemon.after_answer = wrist.after_answer = [&] {
    for (FakeDaemon* const one : {&daemon, &wrist}) one->state.joint_position_rad = 0.0;
    daemon.state.target_position_rad = 0.4;
    wrist.state.target_position_rad = -0.2;
  };
  // Each state triggers the next one until both joints have arrived. The wrist arrives after the elbow.
  struct Playing {
    FakeDaemon &elbow, &wrist;
    int& rounds;
    void on_state(const ReceivedMessage&) {
      if (++rounds > 400) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // a wait of the client lasts 0.1 s

      elbow.state.joint_position_rad = rounds > 10 ? 0.4 : 0.1;
      wrist.state.joint_position_rad = rounds > 120 ? -0.1995 : -0.1;
      elbow.publish_state(rounds > 10 ? Mode::kHolding : Mode::kTracking);
      wrist.publish_state(rounds > 120 ? Mode::kHolding : Mode::kTracking);
    }
  } playing{daemon, wrist, rounds};
  const Subscription states = connection.subscribe("SW\\.elbow\\.STATE", &Playing::on_state, &playing);
  daemon.publish_state(Mode::kTracking);
  EXPECT_EQ(status_of([&] {
              follow_path(client, output, {file_of(kTwoJoints), true});
            }),
            ExitStatus::kDone)
      << message;
  EXPECT_GT(rounds, 120);
  EXPECT_TRUE(output_has("elbow, wrist: arrived in ")) << stream.str();
  EXPECT_TRUE(output_has("largest error -5.00e-04 rad")) << stream.str();
}

/// States of a path that is paused for a while. Each state triggers the next one.
struct PausedPath {
  FakeDaemon &elbow, &wrist;
  int rounds = 0;

  void on_state(const ReceivedMessage&) {
    if (++rounds > 200) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    const bool paused = rounds > 20 && rounds <= 60;
    const bool there = rounds > 90;
    for (FakeDaemon* const one : {&elbow, &wrist}) {
      one->state.target_position_rad = one == &elbow ? 0.4 : -0.2;
      one->state.joint_position_rad = there ? one->state.target_position_rad : 0.1;
      one->state.path_time_s = there ? std::nan("") : paused ? 0.32 : 0.01 * rounds;
      one->state.notices = paused ? static_cast<std::int32_t>(Notice::kPathPaused) : 0;
      if (one == &wrist) one->publish_state(there ? Mode::kHolding : Mode::kTracking);
    }
    elbow.publish_state(there ? Mode::kHolding : Mode::kTracking);
  }
};

TEST_F(PathCommandsTest, WhoWaitsIsToldOnceThatThePathIsPausedAndThatItGoesOn) {
  let_two_joints_hold();
  PausedPath playing{daemon, wrist};
  const Subscription states = connection.subscribe("SW\\.elbow\\.STATE", &PausedPath::on_state, &playing);
  daemon.publish_state(Mode::kTracking);
  EXPECT_EQ(status_of([&] {
              follow_path(client, output, {file_of(kTwoJoints), true});
            }),
            ExitStatus::kDone)
      << message;
  const std::string said = stream.str();
  const std::string paused =
      "elbow, wrist: paused at 0.320 s of 1.000 s; to continue: strainwavectl resume elbow\n";
  EXPECT_EQ(said.find(paused + "elbow, wrist: the path continues\nelbow, wrist: arrived in "), 0U) << said;
}

TEST_F(PathCommandsTest, APauseIsAnObjectOfItsOwnInJson) {
  let_two_joints_hold();
  PausedPath playing{daemon, wrist};
  const Subscription states = connection.subscribe("SW\\.elbow\\.STATE", &PausedPath::on_state, &playing);
  daemon.publish_state(Mode::kTracking);
  const Output json{stream, false, true};
  follow_path(client, json, {file_of(kTwoJoints), true});
  EXPECT_TRUE(
      output_has("{\"joints\":[\"elbow\",\"wrist\"],\"path_s\":1.0,\"arrived\":false,\"paused\":true,"
                 "\"path_time_s\":0.32}\n"))
      << stream.str();
  EXPECT_TRUE(output_has("\"paused\":false")) << stream.str();
}

TEST_F(PathCommandsTest, AWaitThatHasALimitEndsInWhereThePathIsAndThatItIsPaused) {
  let_two_joints_hold();
  const std::vector<JointPath> path = read_path(file_of(kTwoJoints));
  for (FakeDaemon* const one : {&daemon, &wrist}) {
    one->state.target_position_rad = one == &daemon ? 0.4 : -0.2;
    one->state.path_time_s = 0.32;
    one->state.notices = static_cast<std::int32_t>(Notice::kPathPaused);
    one->publish_state(Mode::kTracking);
    client.wait_for_joint(one == &daemon ? "elbow" : "wrist");
  }
  client.catch_up();
  EXPECT_EQ(status_of([&] { (void)wait_for_path(client, path, {.timeout_s = 0.05}); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("elbow: the path did not arrive in 0.05 s: it is paused at 0.320 s of 1.000 s"))
      << message;
}

TEST_F(PathCommandsTest, PauseAndResumeAreOrdersToOneJointOfThePath) {
  let_two_joints_hold();
  pause_path(client, output, "wrist");
  resume_path(client, output, "wrist");
  ASSERT_EQ(wrist.heard().size(), 2U);
  EXPECT_EQ(decode_exactly<command_v1>(wrist.heard()[0].bytes)->action,
            static_cast<std::int32_t>(Action::kPause));
  EXPECT_EQ(decode_exactly<command_v1>(wrist.heard()[1].bytes)->action,
            static_cast<std::int32_t>(Action::kResume));
  EXPECT_TRUE(daemon.heard().empty());
}

}  // namespace
}  // namespace strainwave
