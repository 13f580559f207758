// SPDX-License-Identifier: BSD-3-Clause
// Above 300 lines: what is asked of one signed admission, with the keys and messages that all of it shares.
// Roles of keys, and attacks without a key on the owners of keys.
#include <gtest/gtest.h>

#include <array>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "daemon/admission/admission.h"
#include "lcmtypes/wire.h"
#include "tests/support/wire_message.h"

namespace strainwave {
namespace {

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;
constexpr const char* kSetpoint = "SW.elbow.SETPOINT";
constexpr const char* kCommand = "SW.elbow.COMMAND";
constexpr const char* kTable = "SW.elbow.TABLE";

class SignedAdmission : public ::testing::Test {
 protected:
  SignedAdmission()
      : operator_(SecretKey::generate()),
        engineer_(SecretKey::generate()),
        stranger_(SecretKey::generate()),
        admission_("SW", kSession, {{"elbow", {}, -1.0, 1.0, 34.0}, {"wrist", {}, -1.0, 1.0, 34.0}},
                   {AuthorizedKeys({{operator_.public_key(), Role::kOperator, "Otto"},
                                    {engineer_.public_key(), Role::kEngineer, "Emma"}}),
                    false}) {
    admission_.advance(0, kChallenge);
  }

  template <typename Message>
  static Message filled(std::int64_t sender_id, std::int64_t sequence) {
    Message message{};
    message.session_id = kSession;
    message.challenge = kChallenge;
    message.sender_id = sender_id;
    message.sequence = sequence;
    return message;
  }
  static command_v1 command(Action action, std::int64_t sender_id, std::int64_t sequence) {
    auto message = filled<command_v1>(sender_id, sequence);
    message.action = static_cast<std::int32_t>(action);
    return message;
  }
  Verdict consider(const WireMessage& message) { return admission_.consider(message, now_ns_ += 1'000'000); }
  std::int64_t rejects(Reason reason) const { return admission_.rejects()[static_cast<std::size_t>(reason)]; }

  SecretKey operator_;
  SecretKey engineer_;
  SecretKey stranger_;
  Admission admission_;
  std::int64_t now_ns_ = 0;
  std::int64_t sequence_ = 0;
};

TEST_F(SignedAdmission, ObeysAnOperatorsSetpointsAndCommands) {
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_)).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire(kCommand, command(Action::kEnable, 1, 2), &operator_)).kind, Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, TellsWhoOrderedForTheAnswer) {
  EXPECT_TRUE(consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_)).requester.authentic);
  EXPECT_FALSE(consider(wire(kSetpoint, filled<setpoint_v1>(1, 2), nullptr)).requester.authentic);
  EXPECT_FALSE(consider(wire(kSetpoint, filled<setpoint_v1>(1, 2), &stranger_)).requester.authentic);
  EXPECT_FALSE(consider(wire(kCommand, command(Action::kDisable, 1, 3), nullptr)).requester.authentic);
}

TEST_F(SignedAdmission, LetsOnlyAnEngineerTouchTables) {
  EXPECT_EQ(consider(wire(kTable, filled<gain_table_v1>(1, 1), &operator_)).reason, Reason::kRoleNotAllowed);
  const Verdict revert = consider(wire(kCommand, command(Action::kRevertTable, 1, 2), &operator_));
  EXPECT_EQ(revert.reason, Reason::kRoleNotAllowed);
  EXPECT_NE(revert.text.find("Otto"), std::string::npos);
  EXPECT_NE(revert.text.find("needs engineer"), std::string::npos);
  // The empty table passes the role, and is then refused for its own defect.
  EXPECT_EQ(consider(wire(kTable, filled<gain_table_v1>(1, 1), &engineer_)).reason, Reason::kTableDefect);
  EXPECT_EQ(consider(wire(kCommand, command(Action::kRevertTable, 1, 2), &engineer_)).kind,
            Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 3), &engineer_)).kind, Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, LetsAnOperatorResetFreezeAndResumeLearningAndNoStranger) {
  std::int64_t sequence = 0;
  for (const auto& [action, kind] : {std::pair{Action::kResetLearning, OrderKind::kResetLearning},
                                     {Action::kFreezeLearning, OrderKind::kFreezeLearning},
                                     {Action::kResumeLearning, OrderKind::kResumeLearning}}) {
    const Verdict verdict = consider(wire(kCommand, command(action, 1, ++sequence), &operator_));
    EXPECT_EQ(verdict.kind, Verdict::Kind::kOrder);
    EXPECT_EQ(verdict.order.kind, kind);
    EXPECT_EQ(consider(wire(kCommand, command(action, 1, ++sequence), &stranger_)).kind,
              Verdict::Kind::kRefuse);
  }
}

TEST_F(SignedAdmission, LetsEverybodyStop) {
  auto stop = command(Action::kDisable, 9, -1);
  stop.session_id = 0;
  const std::array<const SecretKey*, 3> keys{nullptr, &operator_, &stranger_};
  for (const SecretKey* key : keys)
    EXPECT_EQ(consider(wire(kCommand, stop, key)).order.kind, OrderKind::kDisable);
  WireMessage bent = wire(kCommand, stop, &operator_);
  bent.bytes[bent.size - 1] ^= 1;
  EXPECT_EQ(consider(bent).kind, Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, RefusesAnOrderThatWasSignedForAnotherJoint) {
  WireMessage message = wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_);
  message.channel = FixedString<64>("SW.wrist.SETPOINT");
  EXPECT_EQ(consider(message).reason, Reason::kBadSignature);
}

TEST_F(SignedAdmission, ASignatureWithoutAKeyIdIsNotTakenForNoSignature) {
  WireMessage message = wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_);
  std::fill_n(message.bytes.begin() + static_cast<std::ptrdiff_t>(message.size - kSealBytes), sizeof(KeyId),
              0);
  EXPECT_EQ(consider(message).reason, Reason::kBadSignature);
}

TEST_F(SignedAdmission, TellsWhoeverDoesNotSignHowAKeyIsGiven) {
  const Verdict verdict = consider(wire(kSetpoint, filled<setpoint_v1>(1, 5), nullptr));
  for (const char* const way :
       {"strainwavectl --key FILE", "Joint in Python and C++", "STRAINWAVE_KEY", "keygen"})
    EXPECT_NE(verdict.text.find(way), std::string::npos) << verdict.text;
  EXPECT_LT(verdict.text.size(), sizeof(ack_v1::text)) << "all of it is sent";
}

TEST_F(SignedAdmission, AForgeryDoesNotUseUpASequenceNumber) {
  const auto order = filled<setpoint_v1>(1, 5);
  WireMessage forged = wire(kSetpoint, filled<setpoint_v1>(1, INT64_MAX), &operator_);
  forged.bytes[forged.size - 1] ^= 1;
  EXPECT_EQ(consider(forged).reason, Reason::kBadSignature);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, INT64_MAX), nullptr)).reason, Reason::kUnsigned);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, INT64_MAX), &stranger_)).reason,
            Reason::kBadSignature);
  EXPECT_EQ(consider(wire(kSetpoint, order, &operator_)).kind, Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, SequencesOfOneKeySayNothingAboutAnotherKeys) {
  EXPECT_TRUE(consider(wire(kCommand, command(Action::kHold, 1, 100), &operator_)).requester.authentic);
  EXPECT_TRUE(consider(wire(kCommand, command(Action::kHold, 1, 50), &engineer_)).requester.authentic);
  EXPECT_FALSE(consider(wire(kCommand, command(Action::kHold, 1, 50), &operator_)).requester.authentic);
}

TEST_F(SignedAdmission, ARoleThatIsNotEnoughUsesUpNothing) {
  EXPECT_EQ(consider(wire(kTable, filled<gain_table_v1>(1, 100), &operator_)).reason,
            Reason::kRoleNotAllowed);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_)).kind, Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, ReplaysStayRefusedAfterAThousandOtherSendersAndForEver) {
  const WireMessage recorded = wire(kSetpoint, filled<setpoint_v1>(1, 1000), &operator_);
  ASSERT_EQ(consider(recorded).kind, Verdict::Kind::kOrder);
  for (std::int64_t sender = 2; sender < 1000; ++sender)
    ASSERT_NE(consider(wire(kSetpoint, filled<setpoint_v1>(sender, 1000 + sender), &operator_)).reason,
              Reason::kOldSequence);
  EXPECT_EQ(consider(recorded).reason, Reason::kOldSequence);
  admission_.advance(1126, 9);
  EXPECT_EQ(consider(recorded).reason, Reason::kTooOld);
}

TEST_F(SignedAdmission, ARepetitionOfTheLastOrderIsOneHoweverOldItIsAndObeyedOnce) {
  const WireMessage last = wire(kSetpoint, filled<setpoint_v1>(1, 1000), &operator_);
  ASSERT_EQ(consider(last).kind, Verdict::Kind::kOrder);
  for (std::int64_t cycle = 0; cycle <= 5000; cycle += 5) admission_.advance(cycle, 10'000 + cycle);
  EXPECT_EQ(consider(last).kind, Verdict::Kind::kRepeat);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 1001), &operator_)).reason, Reason::kTooOld);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(2, 1000), &operator_)).reason, Reason::kTooOld);
}

TEST_F(SignedAdmission, NothingThatWasSentBeforeAFaultIsObeyedAfterIt) {
  const WireMessage move = wire(kSetpoint, filled<setpoint_v1>(1, 100), &operator_);
  const std::int64_t stops = admission_.stop_count(0);
  admission_.fault(0, 0);
  EXPECT_EQ(consider(move).reason, Reason::kTooOld);
  EXPECT_NE(admission_.stop_count(0), stops) << "a table that is proved meanwhile is not taken";
}

TEST_F(SignedAdmission, AnOrderThatIsOvertakenByALaterOneOfTheSameKeyIsWorthless) {
  // An attacker on the path lets the second move pass first, then delivers the earlier one.
  const WireMessage move = wire(kSetpoint, filled<setpoint_v1>(1, 100), &operator_);
  ASSERT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 101), &operator_)).kind, Verdict::Kind::kOrder);
  const Verdict late = consider(move);
  EXPECT_EQ(late.reason, Reason::kOldSequence);
  EXPECT_EQ(late.requester.last_sequence, 101);
}

// A stop overtakes an order, in a burst or because an attacker keeps the order back. Any client may stop, with a key or without.
TEST_F(SignedAdmission, NothingThatWasSentBeforeAStopIsObeyedAfterIt) {
  for (const Action stop : {Action::kDisable, Action::kHold}) {
    const WireMessage move = wire(kSetpoint, filled<setpoint_v1>(1, 100), &operator_);
    const WireMessage enable = wire(kCommand, command(Action::kEnable, 1, 101), &operator_);
    ASSERT_EQ(consider(wire(kCommand, command(stop, 2, 1), nullptr)).kind, Verdict::Kind::kOrder);
    EXPECT_EQ(consider(move).reason, Reason::kSuperseded);
    EXPECT_EQ(consider(enable).reason, Reason::kSuperseded);
  }
}

TEST_F(SignedAdmission, WhoStoppedTheJointHimselfMayGiveAnewWhatHeOrderedAfterThat) {
  ASSERT_EQ(consider(wire(kCommand, command(Action::kHold, 1, 100), &operator_)).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 101), &operator_)).reason, Reason::kTooOld);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 99), &operator_)).reason, Reason::kSuperseded)
      << "ordered before he stopped it, in another window";
}

// The clients of one account share a sender_id, whatever their keys. Anyone may write it into a message.
TEST_F(SignedAdmission, AStopWithTheSameSenderButAnotherKeyOrNoneIsSomebodyElses) {
  const std::array<const SecretKey*, 3> keys{&engineer_, &stranger_, nullptr};
  for (const SecretKey* key : keys) {
    ASSERT_EQ(consider(wire(kCommand, command(Action::kHold, 1, ++sequence_), key)).kind,
              Verdict::Kind::kOrder);
    EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, ++sequence_), &operator_)).reason,
              Reason::kSuperseded);
  }
}

TEST_F(SignedAdmission, AStopOfOneJointLeavesTheOthersTheirOrders) {
  ASSERT_EQ(consider(wire(kCommand, command(Action::kHold, 2, 1), nullptr)).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire("SW.wrist.SETPOINT", filled<setpoint_v1>(1, 100), &operator_)).kind,
            Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, AHoldIsObeyedHoweverManyForgeriesThereAre) {
  WireMessage forged = wire(kCommand, command(Action::kHold, 1, 1), &operator_);
  forged.bytes[forged.size - 1] ^= 1;
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(consider(forged).order.kind, OrderKind::kHold);
  EXPECT_EQ(consider(wire(kCommand, command(Action::kHold, 1, 2), &operator_)).order.kind, OrderKind::kHold);
}

TEST_F(SignedAdmission, KnowsWhoStopsWhenASignatureProvesItAndStopsForTheOthersAllTheSame) {
  EXPECT_TRUE(consider(wire(kCommand, command(Action::kDisable, 1, 1), &operator_)).requester.authentic);
  const Verdict replayed = consider(wire(kCommand, command(Action::kDisable, 1, 1), &operator_));
  EXPECT_EQ(replayed.kind, Verdict::Kind::kOrder);
  EXPECT_FALSE(replayed.requester.authentic);
  EXPECT_FALSE(consider(wire(kCommand, command(Action::kDisable, 1, 2), &stranger_)).requester.authentic);
  EXPECT_TRUE(consider(wire(kCommand, command(Action::kDisable, 1, 3), nullptr)).requester.stop);
}

TEST_F(SignedAdmission, LetsOnlyAnEngineerTakeAJointOver) {
  admission_.settle(consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_)).requester, true,
                    now_ns_);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(2, 1), &engineer_)).reason, Reason::kNotOwner);
  EXPECT_EQ(consider(wire(kCommand, command(Action::kTakeOver, 1, 2), &operator_)).reason,
            Reason::kRoleNotAllowed);
  const Verdict taken = consider(wire(kCommand, command(Action::kTakeOver, 2, 3), &engineer_));
  ASSERT_EQ(taken.kind, Verdict::Kind::kOrder);
  admission_.take_over(taken.requester, now_ns_);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(2, 4), &engineer_)).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(consider(wire(kSetpoint, filled<setpoint_v1>(1, 5), &operator_)).reason, Reason::kNotOwner);
}

TEST_F(SignedAdmission, ChecksASignatureThatIsThereEvenWhereNoneIsNeeded) {
  Admission open("SW", kSession, {{"elbow", {}, -1.0, 1.0, 34.0}}, {{}, true});
  open.advance(0, kChallenge);
  EXPECT_EQ(open.consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), nullptr), 0).kind,
            Verdict::Kind::kOrder);
  EXPECT_EQ(open.consider(wire(kSetpoint, filled<setpoint_v1>(1, 2), &stranger_), 0).reason,
            Reason::kBadSignature);
}

TEST_F(SignedAdmission, SpendsABoundedNumberOfVerificationsOnForgeries) {
  WireMessage forged = wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_);
  forged.bytes[forged.size - 1] ^= 1;
  constexpr int kForgeries = 20'000;
  constexpr double kSeconds = 2.0;
  for (int i = 0; i < kForgeries; ++i)
    admission_.consider(forged, static_cast<std::int64_t>(kSeconds * 1e9 / kForgeries * i));
  const double verified = static_cast<double>(rejects(Reason::kBadSignature));
  constexpr double kAverage = Admission::kWastedVerificationsPer_s * kSeconds;
  EXPECT_GE(verified, kAverage);
  EXPECT_LE(verified, kAverage + Admission::kWastedVerificationsAtOnce);
  EXPECT_EQ(rejects(Reason::kBadSignature) + rejects(Reason::kBusy), kForgeries);
  // A millisecond later, orders of the key's owner are accepted again. Stops were accepted at all times.
  EXPECT_EQ(admission_.consider(wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_), 2'001'000'000).kind,
            Verdict::Kind::kOrder);
}

TEST_F(SignedAdmission, CountsReplaysAgainstTheSameBoundButNotGoodOrders) {
  const WireMessage recorded = wire(kSetpoint, filled<setpoint_v1>(1, 1), &operator_);
  constexpr int kOrders = 1000;
  for (int i = 1; i <= kOrders; ++i)
    ASSERT_EQ(admission_.consider(wire(kSetpoint, filled<setpoint_v1>(1, i), &operator_), 0).kind,
              Verdict::Kind::kOrder);
  for (int i = 0; i < kOrders; ++i) admission_.consider(recorded, 0);
  // A little more than half of the budget. The rest is for other sources.
  const auto verified = static_cast<double>(rejects(Reason::kOldSequence));
  EXPECT_GE(verified, 0.5 * Admission::kWastedVerificationsAtOnce);
  EXPECT_LE(verified, 0.6 * Admission::kWastedVerificationsAtOnce);
  EXPECT_EQ(rejects(Reason::kOldSequence) + rejects(Reason::kBusy), kOrders);
}

// Every good order has its own source, like a program that is started for one order. The forger has up to two thousand sources.
TEST_F(SignedAdmission, VerifiesGoodOrdersAndStopsAmongForgeriesFromManySources) {
  constexpr std::uint64_t kElsewhere = 1U << 20U;
  constexpr int kWarmUp = 15'000;  // until each of the ports has had its first request
  for (const Action action : {Action::kClearFault, Action::kDisable})
    for (const int ports : {200, 400, 2000}) {
      WireMessage forged = wire(kCommand, command(action, 1, 1), &operator_);
      forged.bytes[forged.size - 1] ^= 1;
      const std::int64_t begin_ns = now_ns_;
      for (std::int64_t i = 0; i < 25'000; ++i) {  // five in a millisecond
        forged.source = static_cast<std::uint64_t>(i % ports);
        admission_.consider(forged, now_ns_ = begin_ns + i * 200'000);
        if (i % 500 != 499 || i < kWarmUp) continue;
        WireMessage good = wire(kCommand, command(action, 7, ++sequence_), &operator_);
        good.source = kElsewhere * static_cast<std::uint64_t>(++sequence_);
        EXPECT_TRUE(admission_.consider(good, now_ns_).requester.authentic)
            << i << ", " << to_text(action) << " beside " << ports;
      }
    }
}

TEST_F(SignedAdmission, VerifiesWhoWasRightBeforeHoweverManySourcesForge) {
  ASSERT_TRUE(
      consider(wire(kCommand, command(Action::kClearFault, 7, ++sequence_), &operator_)).requester.authentic);
  WireMessage forged = wire(kCommand, command(Action::kClearFault, 1, 1), &operator_);
  forged.bytes[forged.size - 1] ^= 1;
  for (int i = 0; i < 20'000; ++i) {
    forged.source = static_cast<std::uint64_t>(1 + i);
    admission_.consider(forged, now_ns_ += 100'000);
    if (i % 500 != 499) continue;
    EXPECT_TRUE(
        admission_.consider(wire(kCommand, command(Action::kClearFault, 7, ++sequence_), &operator_), now_ns_)
            .requester.authentic)
        << i;
  }
}

}  // namespace
}  // namespace strainwave
