// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/client.h"

#include <gtest/gtest.h>

#include <strainwave/command_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "strainwave/client_error.h"
#include "tests/client/protocol/fake_daemon.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

constexpr double kShort_s = 0.2;

class ClientTest : public ::testing::Test {
 protected:
  Answer order(const std::string& joint) {
    return client.request(joint, channel_kind::kSetpoint, setpoint_v1{});
  }

  std::string failure(const std::string& joint) {
    try {
      order(joint);
    } catch (const ClientError& error) {
      EXPECT_EQ(error.status(), ExitStatus::kNoAnswer);
      return error.what();
    }
    return "";
  }

  Connection connection{"memq://"};
  FakeDaemon daemon{connection, "SW", "elbow"};
  Client client{connection, {"SW", kShort_s}};
};

TEST_F(ClientTest, LearnsTheSessionFromTheStateAndQuotesIt) {
  daemon.state.session_id = 4711;
  daemon.publish_state();
  EXPECT_TRUE(order("elbow").accepted);
  ASSERT_EQ(daemon.heard().size(), 1U);
  EXPECT_EQ(daemon.heard()[0].channel, "SW.elbow.SETPOINT");
  EXPECT_EQ(decode_exactly<setpoint_v1>(daemon.heard()[0].bytes)->session_id, 4711);
}

TEST(Patience, OfAnyLengthRepeatsAnOrderWhileTheDaemonStillObeysIt) {
  for (const double timeout_s : {0.2, 1.0, 1.5, 20.0, 600.0}) {
    const Patience patience = PendingOrder::patience(sizeof(command_v1), timeout_s);
    EXPECT_LE(PendingOrder::kRepetitions * patience.timeout_s / patience.transmissions,
              PendingOrder::kOrderLifetime_s)
        << timeout_s;
  }
}

TEST_F(ClientTest, RepeatsWhatANetworkCutsIntoPacketsOftenerAndSaysHowOften) {
  daemon.publish_state();
  daemon.drop = 8;
  EXPECT_TRUE(client.request("elbow", channel_kind::kPath, path_v1{}).accepted);
  EXPECT_EQ(daemon.heard().size(), 9U);
  daemon.drop = 100;
  const std::string refused =
      testing::refusal_of<NoAnswer>([&] { (void)client.request("elbow", channel_kind::kPath, path_v1{}); });
  EXPECT_NE(refused.find("after 9 transmissions"), std::string::npos) << refused;
  EXPECT_EQ(daemon.heard().size(), 18U);
}

TEST_F(ClientTest, SaysWhereToLookWhenNothingAnswersInTheWordsOfItsUser) {
  daemon.publish_state();
  daemon.drop = 100;
  EXPECT_TRUE(failure("elbow").ends_with("is not known: see Joint::state()")) << failure("elbow");
  Client command_line{connection, {.prefix = "SW", .timeout_s = kShort_s, .names_commands = true}};
  daemon.publish_state();
  const std::string refused = testing::refusal_of<NoAnswer>(
      [&] { (void)command_line.request("elbow", channel_kind::kSetpoint, setpoint_v1{}); });
  EXPECT_TRUE(refused.ends_with("is not known: see strainwavectl status elbow")) << refused;
}

TEST_F(ClientTest, SaysThatTheDaemonSpeaksAnotherVersion) {
  std::vector<std::uint8_t> older = encode(state_v1{});
  ++older[3];  // a byte of the type's fingerprint
  older.resize(older.size() - 8);
  connection.publish("SW.elbow.STATE", older);
  EXPECT_NE(failure("elbow").find("the daemon on prefix SW has another version"), std::string::npos);
}

TEST_F(ClientTest, TakesATornStateForNoOtherVersion) {
  std::vector<std::uint8_t> torn = encode(state_v1{});
  torn.resize(torn.size() - 8);
  connection.publish("SW.elbow.STATE", torn);
  EXPECT_NE(failure("elbow").find("no daemon on prefix SW"), std::string::npos);
}

TEST_F(ClientTest, PassesOnAReasonAndItsText) {
  daemon.publish_state();
  daemon.reason = Reason::kOutOfRange;
  daemon.text = "position_rad = 9: allowed -1 to 1\x1b";
  const Answer answer = order("elbow");
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.reason, Reason::kOutOfRange);
  EXPECT_EQ(answer.text, "position_rad = 9: allowed -1 to 1?");
}

TEST_F(ClientTest, RepeatsTheIdenticalMessageUntilItIsAnswered) {
  daemon.publish_state();
  daemon.drop = PendingOrder::kRepetitions;
  EXPECT_TRUE(order("elbow").accepted);
  ASSERT_EQ(daemon.heard().size(), 1U + PendingOrder::kRepetitions);
  for (const auto& heard : daemon.heard()) EXPECT_EQ(heard.bytes, daemon.heard()[0].bytes);
}

TEST_F(ClientTest, GivesUpAfterItsRepetitionsAndSaysThatTheOutcomeIsUnknown) {
  daemon.publish_state();
  daemon.drop = 100;
  EXPECT_NE(failure("elbow").find("not known"), std::string::npos);
  EXPECT_EQ(daemon.heard().size(), 1U + PendingOrder::kRepetitions);
}

TEST_F(ClientTest, TellsADaemonThatDoesNotAnswerFromOneWhoseStatesHaveStopped) {
  daemon.publish_state();
  daemon.drop = 100;
  const std::string silent = failure("elbow");
  EXPECT_NE(silent.find(": no state for 0.2 s; is strainwaved running? Whether"), std::string::npos)
      << silent;
  StateAfterState states(connection, daemon);
  daemon.publish_state();
  const std::string mute = failure("elbow");
  EXPECT_NE(mute.find(": the daemon publishes its state but does not answer; see its log. Whether"),
            std::string::npos)
      << mute;
}

TEST_F(ClientTest, DoesNotTakeAnAnswerToAnotherMessageForItsOwn) {
  daemon.publish_state();
  daemon.sequence_error = 1;
  EXPECT_NE(failure("elbow").find("no acknowledgement"), std::string::npos);
}

TEST_F(ClientTest, DoesNotTakeAnAnswerOnAnotherJointsChannelForItsOwn) {
  FakeDaemon wrist(connection, "SW", "wrist");
  wrist.answers_as = "elbow";
  wrist.publish_state();
  EXPECT_NE(failure("wrist").find("no acknowledgement"), std::string::npos);
}

TEST_F(ClientTest, UsesANewSequenceForEveryOrder) {
  daemon.publish_state();
  order("elbow");
  order("elbow");
  EXPECT_GT(decode_exactly<setpoint_v1>(daemon.heard()[1].bytes)->sequence,
            decode_exactly<setpoint_v1>(daemon.heard()[0].bytes)->sequence);
}

TEST_F(ClientTest, SaysThatNoDaemonIsThere) {
  const std::string message = failure("elbow");
  EXPECT_NE(message.find("no daemon on prefix SW"), std::string::npos) << message;
  EXPECT_TRUE(daemon.heard().empty());
}

TEST_F(ClientTest, NamesThePrefixesThatAreHeardInstead) {
  FakeDaemon(connection, "LAB", "elbow").publish_state();
  EXPECT_NE(failure("elbow").find("heard on: LAB"), std::string::npos);
}

TEST_F(ClientTest, NamesTheJointsThatAreHeardInstead) {
  daemon.publish_state();
  EXPECT_NE(failure("elbwo").find("no joint 'elbwo' on prefix SW; its joints are: elbow"), std::string::npos);
}

TEST_F(ClientTest, GivesNoOrderAnewThatCameTooLate) {
  daemon.publish_state();
  daemon.reason = Reason::kTooOld;
  daemon.after_answer = [&] {
    daemon.reason = Reason::kAccepted;
    ++daemon.state.challenge;
    daemon.publish_state();
  };
  EXPECT_EQ(order("elbow").reason, Reason::kTooOld);
  EXPECT_EQ(daemon.heard().size(), 1U);
}

TEST_F(ClientTest, QuotesTheSameStateWhenAnotherProgramOfItsKeyWasAhead) {
  daemon.state.challenge = 100;
  daemon.publish_state();
  daemon.reason = Reason::kOldSequence;
  daemon.after_answer = [&] {
    daemon.reason = Reason::kAccepted;
    daemon.state.challenge = 101;
    daemon.publish_state();
    while (connection.handle(0)) {
    }
  };
  EXPECT_TRUE(order("elbow").accepted);
  ASSERT_EQ(daemon.heard().size(), 2U);
  for (const auto& heard : daemon.heard())
    EXPECT_EQ(decode_exactly<setpoint_v1>(heard.bytes)->challenge, 100);
}

TEST_F(ClientTest, GivesAnOrderAfterItsOwnStopFromAStateThatCameAfterTheAnswer) {
  daemon.state.challenge = 100;
  daemon.publish_state();
  while (connection.handle(0)) {
  }
  daemon.after_answer = [&] {
    ++daemon.state.challenge;
    daemon.publish_state();
  };
  ASSERT_TRUE(client.request_unseen("elbow", channel_kind::kCommand, command_v1{}).accepted);
  EXPECT_TRUE(order("elbow").accepted);
  EXPECT_EQ(decode_exactly<setpoint_v1>(daemon.heard()[1].bytes)->challenge, 101);
}

TEST_F(ClientTest, GivesAnOrderAfterAFaultFromAStateWithAChallengeFromAfterIt) {
  daemon.state.challenge = 100;
  daemon.publish_state();
  daemon.state.fault = static_cast<std::int32_t>(Fault::kEmergencyStop);
  daemon.publish_state(Mode::kFaulted);
  while (connection.handle(0)) {
  }
  ++daemon.state.challenge;
  daemon.publish_state();
  EXPECT_TRUE(order("elbow").accepted);
  EXPECT_EQ(decode_exactly<setpoint_v1>(daemon.heard()[0].bytes)->challenge, 101);
}

TEST_F(ClientTest, GivesNoOrderAnewThatAStopOfSomebodyElseHasOvertaken) {
  daemon.publish_state();
  daemon.reason = Reason::kSuperseded;
  daemon.after_answer = [&] {
    ++daemon.state.challenge;
    daemon.publish_state();
  };
  const Answer answer = order("elbow");
  EXPECT_EQ(answer.reason, Reason::kSuperseded);
  EXPECT_EQ(daemon.heard().size(), 1U);
}

TEST_F(ClientTest, RisesAboveTheSequenceThatTheDaemonNames) {
  daemon.publish_state();
  daemon.reason = Reason::kOldSequence;
  daemon.last_sequence = INT64_MAX / 2;
  daemon.after_answer = [&] { daemon.reason = Reason::kAccepted; };
  EXPECT_TRUE(order("elbow").accepted);
  ASSERT_EQ(daemon.heard().size(), 2U);
  EXPECT_EQ(decode_exactly<setpoint_v1>(daemon.heard()[1].bytes)->sequence, INT64_MAX / 2 + 1);
}

TEST_F(ClientTest, ListsAllJointsOfItsPrefixOnly) {
  daemon.publish_state();
  FakeDaemon(connection, "SW", "wrist").publish_state();
  FakeDaemon(connection, "LAB", "hip").publish_state();
  EXPECT_EQ(client.wait_for_joints(), (std::vector<std::string>{"elbow", "wrist"}));
}

TEST_F(ClientTest, SendsAnUnseenOrderWithoutWaitingForAState) {
  EXPECT_TRUE(client.request_unseen("elbow", channel_kind::kCommand, command_v1{}).accepted);
  ASSERT_EQ(daemon.heard().size(), 1U);
  EXPECT_EQ(decode_exactly<command_v1>(daemon.heard()[0].bytes)->session_id, 0);
}

}  // namespace
}  // namespace strainwave
