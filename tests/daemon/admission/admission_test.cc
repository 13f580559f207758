// SPDX-License-Identifier: BSD-3-Clause
// What passes and what does not, by kind of order. Above 300 lines: orders of one joint on one wire, whose helpers its tests share.
#include "daemon/admission/admission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <utility>

#include "lcmtypes/wire.h"
#include "tests/support/wire_message.h"

namespace strainwave {
namespace {

constexpr double kInertia_kgm2 = 0.089;
constexpr double kTorqueLimit_Nm = 34.0;
constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;

class AdmissionTest : public ::testing::Test {
 protected:
  AdmissionTest()
      : admission_("SW", kSession, {{"elbow", expected(), -1.0, 1.0, 6.0}, {"wrist", {}, -2.0, 2.0, 6.0}},
                   {{}, /*unsigned_allowed=*/true}) {
    admission_.advance(0, kChallenge);
  }

  static ExpectedJoint expected() {
    ExpectedJoint joint;
    joint.plant.inertia_kgm2 = kInertia_kgm2;
    joint.torque_limit_Nm = kTorqueLimit_Nm;
    return joint;
  }
  setpoint_v1 setpoint(double position_rad) {
    setpoint_v1 message{};
    message.session_id = kSession;
    message.challenge = kChallenge;
    message.sender_id = 1;
    message.sequence = ++sequence_;
    message.position_rad = position_rad;
    message.acknowledge = 1;
    return message;
  }
  command_v1 command(Action action) {
    command_v1 message{};
    message.session_id = kSession;
    message.challenge = kChallenge;
    message.sender_id = 1;
    message.sequence = ++sequence_;
    message.action = static_cast<std::int32_t>(action);
    return message;
  }
  Verdict consider(const WireMessage& message) { return admission_.consider(message, 0); }
  std::int64_t rejects(Reason reason) const { return admission_.rejects()[static_cast<std::size_t>(reason)]; }

  Admission admission_;
  std::int64_t sequence_ = 0;
};

TEST_F(AdmissionTest, PassesASoundSetpointToItsJoint) {
  const Verdict verdict = consider(wire("SW.wrist.SETPOINT", setpoint(1.5)));
  ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder);
  EXPECT_EQ(verdict.requester.joint, 1U);
  EXPECT_EQ(verdict.order.kind, OrderKind::kSetpoint);
  EXPECT_EQ(verdict.order.position_rad, 1.5);
}

TEST_F(AdmissionTest, PassesASpeedLimitWithinTheJointsOwnAndRefusesOthers) {
  setpoint_v1 message = setpoint(0.5);
  message.speed_limit_rad_s = 6.0;
  const Verdict passed = consider(wire("SW.elbow.SETPOINT", message));
  ASSERT_EQ(passed.kind, Verdict::Kind::kOrder);
  EXPECT_EQ(passed.order.speed_limit_rad_s, 6.0);
  message = setpoint(0.5);
  message.speed_limit_rad_s = 1e-6;
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", message)).kind, Verdict::Kind::kOrder);
  for (const double speed : {-1e-9, 1e-300, 0.99e-6, 6.001, 1e300}) {
    message = setpoint(0.5);
    message.speed_limit_rad_s = speed;
    const Verdict verdict = consider(wire("SW.elbow.SETPOINT", message));
    EXPECT_EQ(verdict.kind, Verdict::Kind::kRefuse);
    EXPECT_EQ(verdict.reason, Reason::kOutOfRange);
    EXPECT_NE(verdict.text.find("joint.limits.speed_limit_rad_s"), std::string::npos) << verdict.text;
  }
  message = setpoint(0.5);
  message.speed_limit_rad_s = std::nan("");
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", message)).reason, Reason::kNotFinite);
}

TEST_F(AdmissionTest, PassesWhatAStreamTellsOfItsLoadWithinTheJointsOwnAndRefusesOthers) {
  setpoint_v1 sample = setpoint(0.5);
  sample.stream_id = 7;
  sample.valid_for_s = 0.1;
  sample.utime = 1;
  sample.torque_Nm = -kTorqueLimit_Nm;
  sample.load_inertia_kgm2 = 10.0 * kInertia_kgm2;
  const Verdict passed = consider(wire("SW.elbow.SETPOINT", sample));
  ASSERT_EQ(passed.kind, Verdict::Kind::kOrder) << passed.text;
  EXPECT_EQ(passed.order.torque_Nm, -kTorqueLimit_Nm);
  EXPECT_EQ(passed.order.load_inertia_kgm2, 10.0 * kInertia_kgm2);
  const auto refused = [&](double torque_Nm, double inertia_kgm2, bool streamed) {
    setpoint_v1 message = streamed ? sample : setpoint(0.5);
    message.sequence = ++sequence_;
    message.torque_Nm = torque_Nm;
    message.load_inertia_kgm2 = inertia_kgm2;
    return consider(wire("SW.elbow.SETPOINT", message));
  };
  EXPECT_NE(refused(1.001 * kTorqueLimit_Nm, 0.0, true).text.find("joint.limits.torque_limit_Nm"),
            std::string::npos);
  EXPECT_NE(refused(0.0, -1e-9, true).text.find("the joint's inertia"), std::string::npos);
  EXPECT_EQ(refused(0.0, 10.001 * kInertia_kgm2, true).reason, Reason::kOutOfRange);
  EXPECT_EQ(refused(1.0, 0.0, false).reason, Reason::kOutOfRange) << "a move";
  EXPECT_EQ(refused(0.0, 0.01, false).reason, Reason::kOutOfRange) << "a move";
  EXPECT_EQ(refused(std::nan(""), 0.0, true).reason, Reason::kNotFinite);
  EXPECT_EQ(refused(0.0, std::nan(""), true).reason, Reason::kNotFinite);
}

// The printed bound was below the real one in its last digits, or looked the same as the refused value.
TEST_F(AdmissionTest, TakesTheBoundThatItNamesAndPrintsWhatItRefusesApartFromIt) {
  setpoint_v1 sample = setpoint(0.5);
  sample.stream_id = 7;
  sample.valid_for_s = 0.1;
  sample.utime = 1;
  sample.load_inertia_kgm2 = 0.89;  // 10 x 0.089 is less, in its last bit
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", sample)).kind, Verdict::Kind::kOrder);
  const auto refusal = [&](double position_rad, double speed_limit_rad_s, double load_kgm2) {
    setpoint_v1 message = setpoint(position_rad);
    message.speed_limit_rad_s = speed_limit_rad_s;
    if (load_kgm2 > 0.0) message.stream_id = 7, message.valid_for_s = 0.1, message.utime = 1;
    message.load_inertia_kgm2 = load_kgm2;
    return consider(wire("SW.elbow.SETPOINT", message)).text;
  };
  EXPECT_TRUE(
      refusal(0.5, 0.0, 0.8900001).starts_with("load_inertia_kgm2 = 0.8900001: from 0 to 0.89 is allowed"))
      << refusal(0.5, 0.0, 0.8900001);
  EXPECT_TRUE(refusal(1.0000001, 0.0, 0.0).starts_with("position_rad = 1.0000001: from -1 to 1 is allowed"));
  EXPECT_TRUE(refusal(0.5, 6.0000001, 0.0).starts_with("speed_limit_rad_s = 6.0000001: 0 ("));
}

TEST_F(AdmissionTest, JudgesTheRangeByTheJointThatIsMeant) {
  const Verdict verdict = consider(wire("SW.elbow.SETPOINT", setpoint(1.5)));
  EXPECT_EQ(verdict.kind, Verdict::Kind::kRefuse);
  EXPECT_EQ(verdict.reason, Reason::kOutOfRange);
  EXPECT_NE(verdict.text.find("1.5"), std::string::npos);
  EXPECT_NE(verdict.text.find("from -1 to 1"), std::string::npos);
}

TEST_F(AdmissionTest, DiscardsEveryTruncationAndEveryLongerMessage) {
  const WireMessage sound = wire("SW.elbow.SETPOINT", setpoint(0.5));
  std::int64_t expected = 0;
  for (std::uint64_t size = 0; size <= sound.size + 16; ++size) {
    if (size == sound.size) continue;
    WireMessage bent = sound;
    bent.size = size;
    EXPECT_EQ(consider(bent).kind, Verdict::Kind::kDiscard);
    EXPECT_EQ(rejects(Reason::kMalformed), ++expected);
  }
}

TEST_F(AdmissionTest, NeverReadsBeyondTheSlotWhateverSizeItIsTold) {
  WireMessage message = wire("SW.elbow.SETPOINT", setpoint(0.5));
  message.size = ~std::uint64_t{0};
  EXPECT_EQ(consider(message).kind, Verdict::Kind::kDiscard);
}

TEST_F(AdmissionTest, DiscardsAMessageOfAnotherType) {
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", command(Action::kHold))).kind, Verdict::Kind::kDiscard);
}

TEST_F(AdmissionTest, DiscardsOtherPrefixesUnknownJointsAndKinds) {
  EXPECT_EQ(consider(wire("XX.elbow.SETPOINT", setpoint(0.5))).kind, Verdict::Kind::kDiscard);
  EXPECT_EQ(consider(wire("SW.knee.SETPOINT", setpoint(0.5))).reason, Reason::kUnknownJoint);
  EXPECT_EQ(consider(wire("SW.elbow.STATE", setpoint(0.5))).kind, Verdict::Kind::kDiscard);
  EXPECT_EQ(consider(wire("nonsense", setpoint(0.5))).kind, Verdict::Kind::kDiscard);
}

TEST_F(AdmissionTest, RefusesAnotherSession) {
  setpoint_v1 message = setpoint(0.5);
  message.session_id = kSession + 1;
  const Verdict verdict = consider(wire("SW.elbow.SETPOINT", message));
  EXPECT_EQ(verdict.reason, Reason::kWrongSession);
  EXPECT_TRUE(verdict.text.ends_with(
      "strainwaved has restarted. See what the joint does, then send the command again"))
      << verdict.text;
}

TEST_F(AdmissionTest, RepeatsAResentOrderAndRefusesAnOlderOne) {
  const setpoint_v1 first = setpoint(0.1);
  const setpoint_v1 second = setpoint(0.2);
  consider(wire("SW.elbow.SETPOINT", first));
  consider(wire("SW.elbow.SETPOINT", second));
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", second)).kind, Verdict::Kind::kRepeat);
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", first)).reason, Reason::kOldSequence);
}

TEST_F(AdmissionTest, PassesADisableWhateverItsSessionAndSequence) {
  command_v1 message = command(Action::kDisable);
  message.session_id = 0;
  message.sequence = -5;
  for (int i = 0; i < 3; ++i) {
    const Verdict verdict = consider(wire("SW.elbow.COMMAND", message));
    ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder);
    EXPECT_EQ(verdict.order.kind, OrderKind::kDisable);
  }
}

TEST_F(AdmissionTest, RefusesUnknownActionsAndNumbersThatAreNone) {
  command_v1 message = command(Action::kHold);
  message.action = 77;
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", message)).reason, Reason::kUnknownAction);
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", setpoint(std::nan("")))).reason, Reason::kNotFinite);
}

TEST_F(AdmissionTest, RefusesAnOrderThatWasKeptBackForLongerThanItLives) {
  const WireMessage move = wire("SW.elbow.SETPOINT", setpoint(0.5));
  const WireMessage enable = wire("SW.elbow.COMMAND", command(Action::kEnable));
  for (std::int64_t cycle = 0; cycle <= 20'000; cycle += 5) admission_.advance(cycle, 10'000 + cycle);
  for (const WireMessage& kept : {move, enable}) {
    const Verdict verdict = consider(kept);
    EXPECT_EQ(verdict.reason, Reason::kTooOld);
    EXPECT_NE(verdict.text.find("the network delayed the command"), std::string::npos) << verdict.text;
    EXPECT_FALSE(verdict.requester.authentic) << "its answer is not worth remembering";
  }
  EXPECT_EQ(admission_.ownership().owner_id(0, 1), 0);
}

TEST_F(AdmissionTest, SaysOfWhichCycleAnOrdersChallengeIsForWhomAFaultMayComeBefore) {
  admission_.advance(500, kChallenge + 1);
  setpoint_v1 move = setpoint(0.5);
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", move)).order.challenge_cycle, 0);
  move = setpoint(0.5);
  move.challenge = kChallenge + 1;
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", move)).order.challenge_cycle, 500);
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", command(Action::kHold))).order.challenge_cycle, -1);
}

TEST_F(AdmissionTest, SaysInWhichCycleAnOrderExpiresThatMustYetWaitForItsLoop) {
  const Verdict verdict = consider(wire("SW.elbow.SETPOINT", setpoint(0.5)));
  EXPECT_EQ(verdict.order.expires_cycle, 1125);
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", command(Action::kDisable))).order.expires_cycle, -1);
}

TEST_F(AdmissionTest, LetsAnotherHoldAndStopAJointThatSomebodyHasButNotMoveIt) {
  const Verdict move = consider(wire("SW.elbow.SETPOINT", setpoint(0.5)));
  admission_.settle(move.requester, true, 0);
  setpoint_v1 others = setpoint(0.1);
  others.sender_id = 2;
  const Verdict refused = consider(wire("SW.elbow.SETPOINT", others));
  EXPECT_EQ(refused.reason, Reason::kNotOwner);
  EXPECT_NE(refused.text.find("sender 1"), std::string::npos) << refused.text;
  command_v1 hold = command(Action::kHold);
  hold.sender_id = 2;
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", hold)).kind, Verdict::Kind::kOrder);
  command_v1 stop = command(Action::kDisable);
  stop.sender_id = 2;
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", stop)).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(admission_.ownership().owner_id(0, 0), 1) << "neither gained it the joint";
  others.sequence = ++sequence_;
  EXPECT_EQ(consider(wire("SW.wrist.SETPOINT", others)).kind, Verdict::Kind::kOrder);
}

TEST_F(AdmissionTest, ReleasesWithoutTheLoopAndTakesOverWithTheEndOfAStream) {
  admission_.settle(consider(wire("SW.elbow.SETPOINT", setpoint(0.5))).requester, true, 0);
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", command(Action::kRelease))).kind, Verdict::Kind::kDone);
  EXPECT_EQ(admission_.ownership().owner_id(0, 0), 0);
  const Verdict again = consider(wire("SW.elbow.COMMAND", command(Action::kRelease)));
  EXPECT_EQ(again.reason, Reason::kNotOwner);
  EXPECT_NE(again.text.find("the joint has no owner"), std::string::npos) << again.text;
  command_v1 take = command(Action::kTakeOver);
  take.sender_id = 2;
  const Verdict taken = consider(wire("SW.elbow.COMMAND", take));
  EXPECT_EQ(taken.kind, Verdict::Kind::kOrder);
  EXPECT_EQ(taken.order.kind, OrderKind::kEndStream);
  EXPECT_EQ(admission_.ownership().owner_id(0, 0), 0) << "the stream's end is not under way yet";
  ASSERT_TRUE(taken.requester.takes_over);
  admission_.take_over(taken.requester, 0);
  EXPECT_EQ(admission_.ownership().owner_id(0, 0), 2);
}

TEST_F(AdmissionTest, SaysOfASamplesNumbersWhatIsAllowed) {
  setpoint_v1 sample = setpoint(0.5);
  sample.stream_id = 7;
  sample.valid_for_s = 0.1;
  const auto text_with = [&](auto setpoint_v1::*field, auto value) {
    setpoint_v1 wrong = sample;
    wrong.sequence = ++sample.sequence;
    wrong.*field = value;
    return consider(wire("SW.elbow.SETPOINT", wrong)).text;
  };
  EXPECT_EQ(text_with(&setpoint_v1::velocity_rad_s, 1e300),
            "velocity_rad_s = 1e+300: from -1000 to 1000 is allowed");
  EXPECT_EQ(text_with(&setpoint_v1::acceleration_rad_s2, -2e6),
            "acceleration_rad_s2 = -2e+06: from -1e+06 to 1e+06 is allowed");
  EXPECT_EQ(text_with(&setpoint_v1::derivatives, 3),
            "derivatives = 3: 0, 1 (velocity) or 2 (acceleration, too) is allowed");
  EXPECT_EQ(text_with(&setpoint_v1::at_cycle, -1),
            "at_cycle = -1: a future cycle, or 0 for none, is allowed");
}

TEST_F(AdmissionTest, WantsAStreamToHaveANumberAndAMoveToHaveNone) {
  setpoint_v1 message = setpoint(0.5);
  message.valid_for_s = 0.1;
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", message)).reason, Reason::kOutOfRange);
  message = setpoint(0.5);
  message.stream_id = 7;
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", message)).reason, Reason::kOutOfRange);
  message = setpoint(0.5);
  message.stream_id = 7;
  message.valid_for_s = 0.1;
  message.at_cycle = 1;
  message.begins_stream = 1;
  const Verdict verdict = consider(wire("SW.elbow.SETPOINT", message));
  ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder);
  EXPECT_EQ(verdict.order.stream_id, 7);
  EXPECT_TRUE(verdict.order.begins_stream);
}

TEST_F(AdmissionTest, WantsASampleToSayWhenItIsFor) {
  const auto judged = [&](std::int64_t utime, std::int64_t at_cycle) {
    setpoint_v1 sample = setpoint(0.5);
    sample.stream_id = 7;
    sample.valid_for_s = 0.1;
    sample.utime = utime;
    sample.at_cycle = at_cycle;
    return consider(wire("SW.elbow.SETPOINT", sample));
  };
  for (const std::int64_t utime :
       {std::int64_t{1}, std::int64_t{1'700'000'000'000'000}, std::numeric_limits<std::int64_t>::max()}) {
    const Verdict verdict = judged(utime, 0);
    ASSERT_EQ(verdict.kind, Verdict::Kind::kOrder) << utime;
    EXPECT_EQ(verdict.order.sent_us, utime);
  }
  EXPECT_EQ(judged(0, 5).kind, Verdict::Kind::kOrder);
  for (const std::int64_t utime :
       {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min()}) {
    const Verdict verdict = judged(utime, 0);
    EXPECT_EQ(verdict.reason, Reason::kOutOfRange) << utime;
    EXPECT_NE(verdict.text.find("its cycle (at_cycle), or the time when it was sent (utime"),
              std::string::npos)
        << verdict.text;
  }
}

TEST_F(AdmissionTest, WantsAStreamToSaySomethingEveryTenSecondsAtLeast) {
  setpoint_v1 sample = setpoint(0.5);
  sample.stream_id = 7;
  sample.valid_for_s = 10.0;
  sample.utime = 1;
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", sample)).kind, Verdict::Kind::kOrder);
  sample.sequence = ++sequence_;
  sample.valid_for_s = 10.1;
  const Verdict refused = consider(wire("SW.elbow.SETPOINT", sample));
  EXPECT_EQ(refused.reason, Reason::kOutOfRange);
  EXPECT_NE(refused.text.find("at most 10 s"), std::string::npos) << refused.text;
}

TEST_F(AdmissionTest, PassesNothingButStopsOnceTheDaemonEnds) {
  admission_.end_orders();
  for (const Action action : {Action::kEnable, Action::kHome, Action::kTakeOver}) {
    const Verdict verdict = consider(wire("SW.elbow.COMMAND", command(action)));
    EXPECT_EQ(verdict.reason, Reason::kEnding);
    EXPECT_NE(verdict.text.find("ending"), std::string::npos) << verdict.text;
  }
  EXPECT_EQ(consider(wire("SW.elbow.SETPOINT", setpoint(0.5))).reason, Reason::kEnding);
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", command(Action::kDisable))).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire("SW.elbow.COMMAND", command(Action::kHold))).kind, Verdict::Kind::kOrder);
}

}  // namespace
}  // namespace strainwave
