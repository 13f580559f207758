// SPDX-License-Identifier: BSD-3-Clause
// Admission of paths: refusals before any part of a path reaches the loop.
#include <gtest/gtest.h>

#include <cmath>
#include <strainwave/command_v1.hpp>
#include <strainwave/path_v1.hpp>

#include "daemon/admission/admission.h"
#include "tests/support/wire_message.h"

namespace strainwave {
namespace {

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;

JointAdmission joint(const std::string& name) {
  JointAdmission joint;
  joint.name = name;
  joint.path = {{-1.0, 1.0}, {2.0, 10.0, 10.0}, 20.0, 1.0, 0.001};
  return joint;
}

class PathAdmissionTest : public ::testing::Test {
 protected:
  PathAdmissionTest()
      : admission_("SW", kSession, {joint("elbow"), joint("wrist")}, {{}, /*unsigned_allowed=*/true}) {
    admission_.advance(0, kChallenge);
  }
  template <typename Message>
  Message order(std::int64_t sender_id) {
    Message message{};
    message.session_id = kSession;
    message.challenge = kChallenge;
    message.sender_id = sender_id;
    message.sequence = ++sequence_;
    return message;
  }
  /// A path there and back, at rest in `count` knots.
  path_v1 path(int count, std::int64_t sender_id = 1) {
    auto message = order<path_v1>(sender_id);
    message.path_id = 7;
    message.joint_count = 2;
    message.knot_count = count;
    for (int i = 0; i < std::min(count, 320); ++i) {
      message.time_s[i] = 0.5 * i;
      message.position_rad[i] = i % 2 == 0 ? 0.0 : 0.25;
    }
    return message;
  }
  Verdict action(const std::string& channel, Action action, std::int64_t sender_id) {
    auto message = order<command_v1>(sender_id);
    message.action = static_cast<std::int32_t>(action);
    return admission_.consider(wire(channel, message), 0);
  }
  Verdict consider(const path_v1& message, const std::string& channel = "SW.elbow.PATH") {
    return admission_.consider(wire(channel, message), 0);
  }

  Admission admission_;
  std::int64_t sequence_ = 0;
};

TEST_F(PathAdmissionTest, PassesASoundPathWithTheKnotsThatItHas) {
  path_v1 message = path(3);
  message.position_rad[3] = std::nan("");  // beyond the last knot: ignored
  const Verdict verdict = consider(message);
  ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder) << verdict.text;
  EXPECT_EQ(verdict.order.kind, OrderKind::kLoadPath);
  ASSERT_TRUE(verdict.path);
  EXPECT_EQ(verdict.path->id, 7);
  EXPECT_EQ(verdict.path->joint_count, 2);
  EXPECT_EQ(verdict.path->path.count, 3U);
  EXPECT_EQ(verdict.path->path.knots[1].position_rad, 0.25);
  EXPECT_EQ(verdict.text, "3 knots in 1 s");
}

TEST_F(PathAdmissionTest, TakesUpTo320KnotsInOneMessage) {
  EXPECT_LE(encode(path_v1{}).size(), kLargestMessageBytes);
  EXPECT_EQ(consider(path(320)).kind, Verdict::Kind::kOrder);
  for (const int count : {321, 1 << 30, 1, 0, -1, -(1 << 30)}) {
    const Verdict verdict = consider(path(count));
    EXPECT_EQ(verdict.reason, Reason::kOutOfRange) << count;
    EXPECT_NE(verdict.text.find("from 2 to 320"), std::string::npos) << verdict.text;
  }
}

TEST_F(PathAdmissionTest, RefusesByKnotJointAndLimit) {
  path_v1 message = path(5);
  message.velocity_rad_s[2] = 1.2;
  const Verdict verdict = consider(message);
  EXPECT_EQ(verdict.kind, Verdict::Kind::kRefuse);
  EXPECT_EQ(verdict.reason, Reason::kOutOfRange);
  EXPECT_NE(verdict.text.find("elbow, knot 1 (at 0.5 s): acceleration in rad/s^2 = 10.8: at most 10 "),
            std::string::npos)
      << verdict.text;
  message = path(5);
  message.position_rad[3] = 1.5;
  const std::string beyond = consider(message).text;
  EXPECT_NE(beyond.find("elbow, knot 3 (at 1.5 s): position_rad = 1.5: at most 1 is allowed"),
            std::string::npos)
      << beyond;
  message = path(5);
  message.position_rad[3] = std::nan("");
  EXPECT_EQ(consider(message).reason, Reason::kNotFinite);
}

TEST_F(PathAdmissionTest, RefusesNumbersThatNoJointKnowsAsTheyWereGiven) {
  EXPECT_EQ(consider(path(-5)).text, "elbow, knot_count = -5: from 2 to 320 are allowed");
  path_v1 message = path(5);
  message.velocity_rad_s[2] = -1e308;
  EXPECT_EQ(consider(message).text,
            "elbow, knot 2 (at 1 s): speed in rad/s = 1e+308: at most 2 is allowed "
            "(joint.limits.speed_limit_rad_s)");
}

TEST_F(PathAdmissionTest, RefusesAPathOfNobodyAndOfMoreJointsThanThereAre) {
  path_v1 message = path(3);
  message.path_id = 0;
  EXPECT_EQ(consider(message).reason, Reason::kOutOfRange);
  for (const int count : {0, -1, 3}) {
    message = path(3);
    message.joint_count = count;
    EXPECT_EQ(consider(message).reason, Reason::kOutOfRange) << count;
  }
}

TEST_F(PathAdmissionTest, IsStartedOnlyByWhoHasAllOfItsJoints) {
  const Verdict elbow = consider(path(3));
  ASSERT_EQ(elbow.kind, Verdict::Kind::kOrder);
  admission_.settle(elbow.requester, true, 0);
  const Verdict wrist = consider(path(3, 2), "SW.wrist.PATH");
  ASSERT_EQ(wrist.kind, Verdict::Kind::kOrder);
  admission_.settle(wrist.requester, true, 0);
  for (const Action what : {Action::kResume, Action::kPause}) {
    const Verdict verdict = action("SW.elbow.COMMAND", what, 1);
    EXPECT_EQ(verdict.reason, Reason::kNotOwner) << "the wrist is somebody else's";
    EXPECT_EQ(verdict.requester.joint, 0U) << "who asked is answered";
  }
  ASSERT_EQ(action("SW.wrist.COMMAND", Action::kRelease, 2).kind, Verdict::Kind::kDone);
  const Verdict verdict = action("SW.elbow.COMMAND", Action::kResume, 1);
  ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder) << verdict.text;
  EXPECT_EQ(verdict.order.kind, OrderKind::kResumePath);
}

TEST_F(PathAdmissionTest, IsOvertakenByAStop) {
  auto stop = order<command_v1>(3);
  stop.action = static_cast<std::int32_t>(Action::kHold);
  ASSERT_EQ(admission_.consider(wire("SW.elbow.COMMAND", stop), 0).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(path(3)).reason, Reason::kSuperseded);
}

}  // namespace
}  // namespace strainwave
