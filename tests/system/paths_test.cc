// SPDX-License-Identifier: BSD-3-Clause
// Six joints of the real daemon on a path, ordered over LCM.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <strainwave/path_v1.hpp>

#include "tests/support/daemon_fixture.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

const std::vector<std::string> kNames{"elbow", "wrist", "hip", "knee", "neck", "thumb"};

class DaemonPaths : public DaemonTest {
 protected:
  void SetUp() override {
    std::string text = configuration("", "state_rate_Hz = 1000\n");
    const std::string joint = text.substr(text.find("[[joint]]"));
    for (std::size_t i = 1; i < kNames.size(); ++i) {
      std::string other = joint;
      text += "\n" + other.replace(other.find("elbow"), 5, kNames[i]);
    }
    daemon_.emplace(folder_, text);
    for (const std::string& name : kNames) {
      ASSERT_TRUE(client_.wait_for_state(name, [](const state_v1&) { return true; })) << daemon_->log();
      ASSERT_TRUE(client_.load(name, shipped_table()).accepted);
      ASSERT_TRUE(client_.command(name, Action::kEnable).accepted);
    }
    for (const std::string& name : kNames) ASSERT_TRUE(client_.wait_for_mode(name, Mode::kHolding));
  }
  static double way_rad(std::size_t joint) { return 0.1 * static_cast<double>(joint + 1); }
  /// Path to way_rad() in 1 s, with `knots` knots of one cubic.
  path_v1 part(std::size_t joint, int knots = 3) {
    const setpoint_v1 envelope = client_.make_setpoint(kNames[joint], 0.0);
    path_v1 message{};
    message.session_id = envelope.session_id;
    message.challenge = envelope.challenge;
    message.sender_id = envelope.sender_id;
    message.sequence = envelope.sequence;
    message.path_id = 4711;
    message.joint_count = static_cast<std::int32_t>(kNames.size());
    message.knot_count = knots;
    for (int i = 0; i < knots; ++i) {
      const double u = static_cast<double>(i) / (knots - 1);
      message.time_s[i] = u;
      message.position_rad[i] = way_rad(joint) * u * u * (3.0 - 2.0 * u);
      message.velocity_rad_s[i] = i + 1 == knots ? 0.0 : way_rad(joint) * 6.0 * u * (1.0 - u);
    }
    return message;
  }
  /// Loads the path of every joint, with as many knots as fit into a message.
  void load_all() {
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const Answer answer =
          client_.send_and_wait(kNames[i], "PATH", part(i, static_cast<int>(std::size(path_v1{}.time_s))));
      ASSERT_TRUE(answer.accepted) << kNames[i] << ": " << answer.text;
    }
  }
  /// Largest difference in one cycle between two joints' shares of their ways.
  double disagreement() {
    std::map<std::int64_t, std::pair<double, double>> shares;
    for (std::size_t i = 0; i < kNames.size(); ++i)
      for (const state_v1& state : client_.history(kNames[i])) {
        const double share = state.setpoint_position_rad / way_rad(i);
        const auto [found, first] = shares.try_emplace(state.cycle, share, share);
        if (first) continue;
        found->second.first = std::min(found->second.first, share);
        found->second.second = std::max(found->second.second, share);
      }
    double largest = 0.0;
    for (const auto& [cycle, range] : shares) largest = std::max(largest, range.second - range.first);
    return largest;
  }

  std::optional<DaemonProcess> daemon_;
  TestClient client_;
};

TEST_F(DaemonPaths, LeavePauseAndArriveInOneCycle) {
  load_all();
  client_.forget_states();
  ASSERT_TRUE(client_.command("knee", Action::kResume).accepted);
  client_.pump(milliseconds(400));
  ASSERT_TRUE(client_.command("hip", Action::kPause).accepted);
  client_.pump(milliseconds(500));
  for (const std::string& name : kNames) {
    EXPECT_EQ(client_.state(name)->setpoint_velocity_rad_s, 0.0) << name;
    EXPECT_NE(client_.state(name)->notices & static_cast<std::int32_t>(Notice::kPathPaused), 0) << name;
    EXPECT_EQ(client_.state(name)->path_time_s, client_.state("elbow")->path_time_s) << name;
  }
  ASSERT_TRUE(client_.command("wrist", Action::kResume).accepted);
  for (const std::string& name : kNames)
    ASSERT_TRUE(client_.wait_for_mode(name, Mode::kHolding)) << daemon_->log();
  for (std::size_t i = 0; i < kNames.size(); ++i)
    EXPECT_NEAR(client_.state(kNames[i])->joint_position_rad, way_rad(i), 5e-4) << kNames[i];
  // If the loop misses periods, the limits may take the setpoints off the path until they catch up.
  std::printf("setpoints disagree by %.1e of their ways\n", disagreement());
  if (in_virtual_time()) {
    EXPECT_LT(disagreement(), 1e-5);
  }
}

TEST_F(DaemonPaths, AreRefusedByJointKnotAndLimitBeforeAnythingMoves) {
  path_v1 fast = part(1);
  fast.time_s[1] = 0.01;
  client_.forget_states();
  const Answer answer = client_.send_and_wait("wrist", "PATH", fast);
  EXPECT_EQ(answer.reason, Reason::kOutOfRange);
  EXPECT_NE(answer.text.find("wrist, knot 0"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("joint.limits."), std::string::npos) << answer.text;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (i == 1) continue;
    ASSERT_TRUE(client_.send_and_wait(kNames[i], "PATH", part(i)).accepted);
  }
  const Answer incomplete = client_.command("elbow", Action::kResume);
  EXPECT_FALSE(incomplete.accepted);
  EXPECT_NE(incomplete.text.find("the daemon has the path's parts for 5 of its 6 joints"), std::string::npos)
      << incomplete.text;
  client_.pump(milliseconds(100));
  for (const std::string& name : kNames)
    for (const state_v1& state : client_.history(name)) ASSERT_EQ(state.setpoint_velocity_rad_s, 0.0) << name;
}

TEST_F(DaemonPaths, EndForAllJointsWhenOneIsToldToHold) {
  load_all();
  ASSERT_TRUE(client_.command("elbow", Action::kResume).accepted);
  client_.pump(milliseconds(300));
  ASSERT_TRUE(client_.command("thumb", Action::kHold).accepted);
  for (const std::string& name : kNames)
    ASSERT_TRUE(client_.wait_for_mode(name, Mode::kHolding)) << daemon_->log();
  for (std::size_t i = 0; i < kNames.size(); ++i)
    EXPECT_LT(client_.state(kNames[i])->joint_position_rad, 0.9 * way_rad(i)) << kNames[i];
}

}  // namespace
}  // namespace strainwave::testing
