// SPDX-License-Identifier: BSD-3-Clause
// Paths of libstrainwave-client with a fake daemon. docs/client.md shows them with strainwaved.
#include "strainwave/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <strainwave/command_v1.hpp>
#include <strainwave/path_v1.hpp>

#include "lcmtypes/wire.h"
#include "tests/client/protocol/running_daemon.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

class PathTest : public ::testing::Test {
 protected:
  static Joint joint(const std::string& name, const std::string& prefix = "SW") {
    return Joint(name, {.key = "", .prefix = prefix, .lcm_url = own_url(), .timeout_s = 20.0});
  }

  RunningDaemon daemon{own_url()};
};

TEST_F(PathTest, LoadsItsKnotsAndStartsThemAndArrives) {
  Joint elbow = joint("elbow");
  Path path({{elbow, {{0, 0, 0}, {0.5, 0.2, 0.6}, {1, 0.4, 0}}}});
  daemon.daemon().after_answer = [this] {
    daemon.daemon().state.target_position_rad = 0.4;
    daemon.daemon().state.joint_position_rad = 0.3999;
  };
  path.start();
  const std::vector<Arrival> arrivals = path.wait();
  path.pause();
  path.resume();
  daemon.stop();
  ASSERT_EQ(arrivals.size(), 1U);
  EXPECT_NEAR(arrivals[0].error_rad, 1e-4, 1e-12);
  const auto& heard = daemon.daemon().heard();
  ASSERT_EQ(heard.size(), 4U);
  const auto part = decode_exactly<path_v1>(heard[0].bytes);
  ASSERT_TRUE(part);
  EXPECT_NE(part->path_id, 0);
  EXPECT_EQ(part->joint_count, 1);
  EXPECT_EQ(part->knot_count, 3);
  EXPECT_EQ(part->velocity_rad_s[1], 0.6);
  const auto action = [&](std::size_t i) { return decode_exactly<command_v1>(heard[i].bytes)->action; };
  EXPECT_EQ(action(1), static_cast<std::int32_t>(Action::kResume));
  EXPECT_EQ(action(2), static_cast<std::int32_t>(Action::kPause));
  EXPECT_EQ(action(3), static_cast<std::int32_t>(Action::kResume));
}

TEST_F(PathTest, AWaitThatHasALimitEndsInWhereThePathIsAndThatItIsPaused) {
  Joint elbow = joint("elbow");
  Path path({{elbow, {{0, 0, 0}, {1, 0.4, 0}}}});
  daemon.daemon().after_answer = [this] {
    daemon.daemon().state.target_position_rad = 0.4;
    daemon.daemon().state.path_time_s = 0.25;
    daemon.daemon().state.notices = static_cast<std::int32_t>(Notice::kPathPaused);
  };
  path.start();
  const std::string refused = testing::refusal_of<NotDone>([&] { path.wait(1e-3, 0.5); });
  EXPECT_EQ(refused, "elbow: the path did not arrive in 0.5 s: it is paused at 0.250 s of 1.000 s");
  EXPECT_THROW(path.wait(1e-3, 0.0), InvalidInput);
}

TEST_F(PathTest, AWaitForWhatNobodyStartedSaysSo) {
  Joint elbow = joint("elbow");
  Path path({{elbow, {{0, 0, 0}, {1, 0.4, 0}}}});
  const std::string refused = testing::refusal_of<NotDone>([&] { path.wait(); });
  EXPECT_EQ(refused, "elbow: is not on its way to 0.4 rad: this path is not under way; start() begins it");
}

TEST_F(PathTest, AWaitForWhatNobodyStartedSaysSoWhereTheJointStandsAtItsEnd) {
  auto& state = daemon.daemon().state;
  state.path_time_s = std::nan("");
  state.target_position_rad = state.joint_position_rad = 0.4;
  Joint elbow = joint("elbow");
  Path path({{elbow, {{0, 0, 0}, {1, 0.4, 0}}}});
  EXPECT_THROW(path.wait(), NotDone);
}

TEST_F(PathTest, AWaitForWhatAnotherProgramStartedReturnsWhenItIsThere) {
  auto& state = daemon.daemon().state;
  state.target_position_rad = state.joint_position_rad = 0.4;
  state.path_time_s = 0.9;
  Joint elbow = joint("elbow");
  Path path({{elbow, {{0, 0, 0}, {1, 0.4, 0}}}});
  EXPECT_EQ(path.wait().size(), 1U);
}

TEST_F(PathTest, WhatIsNoPathIsRefusedBeforeAnythingIsSent) {
  const Joint elbow = joint("elbow");
  const Joint of_another_daemon = joint("wrist", "LEFT");
  const std::vector<JointKnot> knots{{0, 0, 0}, {1, 0.1, 0}};
  const std::vector<std::pair<std::vector<PathPart>, std::string>> cases{
      {{}, "at least one joint"},
      {{{elbow, knots}, {elbow, knots}}, "elbow is named twice"},
      {{{elbow, knots}, {of_another_daemon, knots}}, "wrist has prefix LEFT, elbow has SW"},
      {{{elbow, {{0, 0, 0}}}}, "elbow: 1 knot: 2 to 320"},
      {{{elbow, std::vector<JointKnot>(321)}}, "elbow: 321 knots: 2 to 320"},
      {{{elbow, {{0, 0, 0}, {1, std::nan(""), 0}}}}, "elbow: knot 1: position_rad = nan: a finite"}};
  for (const auto& [parts, words] : cases) {
    const std::string refusal = testing::refusal_of<InvalidInput>([&] { const Path path(parts); });
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  }
  daemon.stop();
  EXPECT_TRUE(daemon.daemon().heard().empty());
}

}  // namespace
}  // namespace strainwave
