// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/order_desk.h"

#include <gtest/gtest.h>

#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "base/input_error.h"
#include "client/protocol/key_file.h"
#include "tests/client/protocol/fake_daemon.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class OrderDeskTest : public ::testing::Test {
 protected:
  void handle(double seconds, OrderDesk& desk) {
    for (const Deadline end(seconds); !end.passed();) {
      connection_.handle(5);
      desk.tick();
    }
  }
  Connection connection_{"memq://"};
  StateView states_{connection_};
  FakeDaemon daemon_{connection_, "ARM2", "elbow"};
  TemporaryFolder folder_;
};

TEST_F(OrderDeskTest, AStopGoesOutUnsignedWhenTheKeyCannotBeUsedAndNeedsNoSession) {
  OrderDesk desk(connection_, states_, "/nonexistent/key",
                 0.4);  // an unusable key must not delay a stop
  desk.stop({{"ARM2", "elbow"}});
  handle(0.1, desk);
  ASSERT_EQ(daemon_.heard().size(), 1U);
  const auto command = decode_exactly<command_v1>(daemon_.heard()[0].bytes);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->action, static_cast<std::int32_t>(Action::kDisable));
  EXPECT_TRUE(is_unsigned(daemon_.heard()[0].bytes));
  EXPECT_EQ(desk.message(), "ARM2.elbow: disable accepted");
  EXPECT_FALSE(desk.alarm());
}

TEST_F(OrderDeskTest, RepeatsTheSameOrderUntilItIsAnswered) {
  daemon_.drop = 2;
  OrderDesk desk(connection_, states_, "", 0.4);
  desk.stop({{"ARM2", "elbow"}});
  handle(1.3, desk);
  ASSERT_EQ(daemon_.heard().size(), 3U);
  EXPECT_EQ(daemon_.heard()[0].bytes, daemon_.heard()[2].bytes);
  EXPECT_EQ(desk.message(), "ARM2.elbow: disable accepted");
}

TEST_F(OrderDeskTest, SaysSoWhenNobodyAnswers) {
  daemon_.drop = 100;
  OrderDesk desk(connection_, states_, "", 0.2);
  desk.stop({{"ARM2", "elbow"}});
  handle(PendingOrder::kStopPatience_s + 0.3, desk);
  EXPECT_EQ(desk.message(), "ARM2.elbow: disable: no answer");
  EXPECT_TRUE(desk.alarm());
  EXPECT_EQ(daemon_.heard().size(), static_cast<std::size_t>(PendingOrder::kStopTransmissions))
      << "and does not go on for ever";
}

TEST_F(OrderDeskTest, AStopOfSeveralCountsItsAnswersAndNamesWhoIsSilent) {
  OrderDesk desk(connection_, states_, "", 0.2);
  desk.stop({{"ARM2", "elbow"}, {"ARM2", "ghost"}});
  EXPECT_EQ(desk.message(), "2 joints: disable sent");
  handle(PendingOrder::kStopPatience_s + 0.3, desk);
  EXPECT_EQ(desk.message(), "2 joints: disable, 1 accepted; ARM2.ghost: no answer");
  EXPECT_TRUE(desk.alarm());
}

TEST_F(OrderDeskTest, AStopIsSignedWhenItCanBe) {
  const auto key = folder_.path() / "key";
  const AuthorizedKey made = write_new_key(key, Role::kOperator, "test");
  daemon_.state.session_id = 4711;
  daemon_.state.challenge = 815;
  OrderDesk desk(connection_, states_, key, 0.4);
  daemon_.publish_state();
  handle(0.05, desk);
  desk.stop({{"ARM2", "elbow"}});
  handle(0.1, desk);
  ASSERT_EQ(daemon_.heard().size(), 1U);
  EXPECT_TRUE(verify("ARM2.elbow.COMMAND", made.key, daemon_.heard()[0].bytes));
  EXPECT_EQ(decode_exactly<command_v1>(daemon_.heard()[0].bytes)->challenge, 815);
}

TEST_F(OrderDeskTest, AnOrderOfAKeyWithAnotherProgramAheadGoesOutAboveItFromTheSameState) {
  OrderDesk desk(connection_, states_, "", 0.4);
  daemon_.state.challenge = 1;
  daemon_.publish_state();
  handle(0.05, desk);
  daemon_.reason = Reason::kOldSequence;
  daemon_.after_answer = [&] { daemon_.reason = Reason::kAccepted; };
  desk.order({"ARM2", "elbow"}, Action::kEnable);
  daemon_.state.challenge = 2;
  daemon_.publish_state();
  handle(0.1, desk);
  ASSERT_EQ(daemon_.heard().size(), 2U);
  EXPECT_EQ(decode_exactly<command_v1>(daemon_.heard()[0].bytes)->challenge, 1);
  EXPECT_EQ(decode_exactly<command_v1>(daemon_.heard()[1].bytes)->challenge, 1);
  EXPECT_EQ(desk.message(), "ARM2.elbow: enable accepted");
}

TEST_F(OrderDeskTest, AnOrderThatAStopOfSomebodyElseHasOvertakenIsNotGivenAnew) {
  OrderDesk desk(connection_, states_, "", 0.4);
  daemon_.state.challenge = 1;
  daemon_.publish_state();
  handle(0.05, desk);
  daemon_.reason = Reason::kSuperseded;
  desk.order({"ARM2", "elbow"}, Action::kEnable);
  daemon_.state.challenge = 2;
  daemon_.publish_state();
  handle(0.1, desk);
  EXPECT_EQ(daemon_.heard().size(), 1U);
  EXPECT_TRUE(desk.alarm());
}

TEST_F(OrderDeskTest, SaysThatThereIsNoFaultInsteadOfClearingIt) {
  OrderDesk desk(connection_, states_, "", 0.4);
  daemon_.publish_state(Mode::kHolding);
  handle(0.05, desk);
  desk.order({"ARM2", "elbow"}, Action::kClearFault);
  handle(0.05, desk);
  EXPECT_TRUE(daemon_.heard().empty());
  EXPECT_EQ(desk.message(), "ARM2.elbow: has no fault");
  EXPECT_FALSE(desk.alarm());
  daemon_.publish_state(Mode::kFaulted);
  handle(0.05, desk);
  desk.order({"ARM2", "elbow"}, Action::kClearFault);
  handle(0.05, desk);
  EXPECT_EQ(daemon_.heard().size(), 1U);
}

TEST_F(OrderDeskTest, WhatWasTrueLongAgoIsNotSaidAnyMore) {
  OrderDesk desk(connection_, states_, "", 20.0);
  const auto later = [](double seconds) {
    return now() + std::chrono::duration_cast<Instant::duration>(std::chrono::duration<double>(seconds));
  };
  daemon_.publish_state(Mode::kHolding);
  handle(0.05, desk);
  desk.order({"ARM2", "elbow"}, Action::kClearFault);
  EXPECT_EQ(desk.message(later(9.0)), "ARM2.elbow: has no fault");
  EXPECT_EQ(desk.message(later(11.0)), "") << "it may have one by now";
  daemon_.drop = 1;
  desk.stop({{"ARM2", "elbow"}});
  EXPECT_EQ(desk.message(later(15.0)), "ARM2.elbow: disable sent") << "and is not answered yet";
}

TEST_F(OrderDeskTest, AnOrderThatWasTooOldIsNotGivenAnew) {
  OrderDesk desk(connection_, states_, "", 0.4);
  daemon_.reason = Reason::kTooOld;
  daemon_.after_answer = [&] {
    ++daemon_.state.challenge;
    daemon_.publish_state();
  };
  desk.order({"ARM2", "elbow"}, Action::kEnable);
  handle(0.3, desk);
  EXPECT_EQ(daemon_.heard().size(), 1U);
  EXPECT_TRUE(desk.alarm());
}

TEST_F(OrderDeskTest, AJogIsAnAcknowledgedMove) {
  daemon_.state.session_id = 4711;
  daemon_.publish_state();
  OrderDesk desk(connection_, states_, "", 0.4);
  handle(0.05, desk);
  desk.move({"ARM2", "elbow"}, 0.25);
  handle(0.1, desk);
  ASSERT_EQ(daemon_.heard().size(), 1U);
  const auto setpoint = decode_exactly<setpoint_v1>(daemon_.heard()[0].bytes);
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->position_rad, 0.25);
  EXPECT_EQ(setpoint->session_id, 4711);
  EXPECT_EQ(setpoint->valid_for_s, 0.0) << "the joint stays there";
  EXPECT_EQ(desk.message(), "ARM2.elbow: move to 0.25 rad accepted");
}

TEST_F(OrderDeskTest, SignsOtherOrdersForTheSessionOfTheJoint) {
  const auto key = folder_.path() / "key";
  const AuthorizedKey made = write_new_key(key, Role::kOperator, "test");
  OrderDesk desk(connection_, states_, key, 0.4);
  daemon_.reason = Reason::kFaulted;
  daemon_.text = "see its fault\x1b[2J";
  daemon_.state.session_id = 4711;
  daemon_.publish_state();
  handle(0.05, desk);
  desk.order({"ARM2", "elbow"}, Action::kEnable);
  handle(0.1, desk);
  ASSERT_EQ(daemon_.heard().size(), 1U);
  EXPECT_EQ(decode_exactly<command_v1>(daemon_.heard()[0].bytes)->session_id, 4711);
  EXPECT_TRUE(verify("ARM2.elbow.COMMAND", made.key, daemon_.heard()[0].bytes));
  EXPECT_EQ(desk.message(), "ARM2.elbow: enable: refused, joint is faulted: see its fault?[2J");
  EXPECT_TRUE(desk.alarm());
  ASSERT_EQ(desk.refusals().size(), 1U);
  EXPECT_EQ(desk.refusals().front().text, desk.message());
  OrderDesk without(connection_, states_, "/nonexistent/key", 0.4);
  EXPECT_THROW(without.order({"ARM2", "elbow"}, Action::kEnable), InputError);
}

}  // namespace
}  // namespace strainwave
