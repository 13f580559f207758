// SPDX-License-Identifier: BSD-3-Clause
// Motions for which the command waits.
#include <gtest/gtest.h>

#include <cmath>
#include <strainwave/setpoint_v1.hpp>

#include "client/protocol/joint_path.h"
#include "client/protocol/motion.h"
#include "tests/client/commands/commands_fixture.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

TEST_F(CommandsTest, HomeReturnsOnceTheJointHoldsAndOnlyCallsAHomedJointHomed) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kHolding, Mode::kHoming, Mode::kHoming, Mode::kHolding};
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kDone);
  EXPECT_TRUE(output_has("elbow: homed"));
  daemon.state.notices = static_cast<std::int32_t>(Notice::kNotHomed);
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("before it found home")) << message;
  daemon.modes_after_answer = {Mode::kHoming, Mode::kStopping};
  EXPECT_EQ(status_of([&] { home(client, output, "elbow"); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("did not find home: the joint was disabled")) << message;
}

TEST_F(CommandsTest, MoveAsksForAnAcknowledgementOfAMoveNotAStream) {
  daemon.publish_state(Mode::kHolding);
  move(client, output, {"elbow", -0.25, false});
  const auto setpoint = decode_exactly<setpoint_v1>(daemon.heard().at(0).bytes);
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->position_rad, -0.25);
  EXPECT_EQ(setpoint->valid_for_s, 0.0);
  EXPECT_EQ(setpoint->acknowledge, 1);
}

TEST_F(CommandsTest, MoveWaitsUntilTheJointHoldsAtTheTarget) {
  daemon.publish_state(Mode::kHolding);
  // The daemon sent the first of these states before it received the order.
  daemon.modes_after_answer = {Mode::kHolding, Mode::kTracking, Mode::kTracking, Mode::kHolding};
  daemon.after_answer = [&] { daemon.state.joint_position_rad = 0.4995; };
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kDone) << message;
  EXPECT_TRUE(output_has("arrived at 0.5 rad in ")) << stream.str();
  EXPECT_TRUE(output_has("error 5.00e-04 rad")) << stream.str();
  EXPECT_EQ(client.find("elbow")->messages, 5);
}

TEST_F(CommandsTest, MoveDoesNotCallItArrivedOutsideOfTheTolerance) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kHolding};
  daemon.after_answer = [&] { daemon.state.joint_position_rad = 0.49; };
  EXPECT_NE(move_and_wait(0.5), ExitStatus::kDone);
  EXPECT_FALSE(output_has("arrived"));
}

// The move ends before any state shows that the joint moves.
TEST_F(CommandsTest, MoveThatIsShortIsNotSaidToHaveTakenAsLongAsOldStatesMayCome) {
  daemon.publish_state(Mode::kHolding);
  StateAfterState states(connection, daemon);
  EXPECT_EQ(move_and_wait(0.0004), ExitStatus::kDone) << message;
  EXPECT_TRUE(output_has("arrived at 0.0004 rad in less than 0.01 s, error")) << stream.str();
}

TEST_F(CommandsTest, MoveThatHoldsOutsideSaysHowFarInAsManyDigitsAsShowIt) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kHolding};
  StateAfterState states(connection, daemon);
  daemon.after_answer = [&] { daemon.state.joint_position_rad = 0.5010004; };
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("holds -1.0004e-03 rad away from 0.5 rad, outside of tolerance_rad 0.001"))
      << message;
  EXPECT_EQ(error_text(0.25, 0.001), "2.50e-01");
  EXPECT_EQ(error_text(-9.9996e-4, 9.9997e-4), "-9.9996e-04");
  EXPECT_EQ(error_text(std::nan(""), 0.001), "nan");
}

TEST_F(CommandsTest, MoveEndsWithTheFaultThatEndedIt) {
  daemon.publish_state(Mode::kHolding);
  daemon.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kFaulted};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("following error")) << message;
}

TEST_F(CommandsTest, MoveEndsWhenAnotherOrderReplacesIt) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking};
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    daemon.state.target_position_rad = 0.1;  // a hold
  };
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("another command")) << message;
}

TEST_F(CommandsTest, MoveThatALoadEndsSaysWhichAndWhereTheJointHolds) {
  daemon.publish_state(Mode::kHolding);
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    daemon.show_yield();
    daemon.state.target_position_rad = daemon.state.joint_position_rad = 0.29;
    daemon.publish_state(Mode::kTracking);
    daemon.state.joint_position_rad = 0.2871;
  };
  daemon.modes_after_answer = {Mode::kTracking, Mode::kHolding};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_EQ(
      message,
      "elbow: did not arrive at 0.5 rad: it yielded to a load of 13.1 N.m (load_Nm allows 12) at 0.3011 "
      "rad; it holds at 0.2871 rad");
  EXPECT_EQ(details.joint, "elbow");
  ASSERT_TRUE(details.yielded_to);
  EXPECT_EQ(details.yielded_to->load_Nm, -13.1042);
  EXPECT_EQ(details.yielded_to->limit_Nm, 12.0);
  EXPECT_EQ(details.yielded_to->position_rad, 0.3011);
}

TEST_F(CommandsTest, MoveThatALoadEndsInAFaultTellsTheFault) {
  daemon.publish_state(Mode::kHolding);
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    daemon.show_yield();
    daemon.state.target_position_rad = 0.29;
    daemon.state.fault = static_cast<std::int32_t>(Fault::kOverload);
  };
  daemon.modes_after_answer = {Mode::kTracking, Mode::kFaulted};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("24: load too large")) << message;
}

// A state that the daemon sent before it received the order still reports the earlier load.
TEST_F(CommandsTest, MoveIsNotEndedByALoadOfBefore) {
  daemon.publish_state(Mode::kHolding);
  daemon.obeys_moves = false;
  daemon.after_answer = [&] {
    daemon.show_yield();
    daemon.state.target_position_rad = 0.29;
    daemon.publish_state(Mode::kTracking);
    daemon.state.notices = 0;
    daemon.state.target_position_rad = daemon.state.joint_position_rad = 0.5;
  };
  daemon.modes_after_answer = {Mode::kTracking, Mode::kHolding};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kDone) << message;
}

TEST_F(CommandsTest, MoveEndsWhenTheJointIsDisabledOrTheDaemonRestarted) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking, Mode::kStopping};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("disabled")) << message;
  daemon.modes_after_answer = {Mode::kTracking};
  daemon.after_answer = [&] {
    daemon.publish_state(Mode::kTracking);
    ++daemon.state.session_id;
  };
  EXPECT_EQ(move_and_wait(0.6), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("restarted")) << message;
}

TEST_F(CommandsTest, MoveSaysSoWhenTheDaemonFallsSilent) {
  daemon.publish_state(Mode::kHolding);
  daemon.modes_after_answer = {Mode::kTracking};
  EXPECT_EQ(move_and_wait(0.5), ExitStatus::kNoAnswer);
  EXPECT_EQ(message,
            "elbow: lost contact with strainwaved during the motion: no state for 0.3 s; the joint may still "
            "be moving");
}

TEST_F(CommandsTest, AMoveOfMoreThanAnHourIsRefusedWithTheLeastSpeedThatIsAllowed) {
  daemon.publish_state(Mode::kHolding);
  for (const bool wait : {false, true}) {
    MoveArguments slow{"elbow", 0.5, wait};
    slow.speed_limit_rad_s = 1e-300;
    EXPECT_EQ(status_of([&] { move(client, output, slow); }), ExitStatus::kUsage);
    EXPECT_TRUE(
        message_has("elbow: speed_limit_rad_s = 1e-300: at least 0.00014 is allowed: the way of 0.5 rad"))
        << message;
  }
  EXPECT_TRUE(daemon.heard().empty());
  MoveArguments just{"elbow", 0.5, false};
  just.speed_limit_rad_s = 0.00014;
  EXPECT_EQ(status_of([&] { move(client, output, just); }), ExitStatus::kDone) << message;
}

TEST_F(CommandsTest, RefusedMoveThatLooksLikeDegreesGetsAHint) {
  daemon.publish_state(Mode::kHolding);
  daemon.reason = Reason::kOutOfRange;
  EXPECT_EQ(status_of([&] { move(client, output, {"elbow", 90.0, false}); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("90 degrees would be 1.5708")) << message;
  EXPECT_EQ(status_of([&] { move(client, output, {"elbow", 3.0, false}); }), ExitStatus::kRefused);
  EXPECT_FALSE(message_has("degrees")) << message;
}

TEST_F(CommandsTest, ARefusedPathThatLooksLikeDegreesGetsAHint) {
  daemon.publish_state(Mode::kHolding);
  daemon.reason = Reason::kOutOfRange;
  const auto load = [&](double middle_rad) {
    return status_of([&] {
      load_path(client, {{"elbow", {{0, 0, 0}, {0.5, middle_rad, 0}, {1, 0.5 * middle_rad, 0}}}});
    });
  };
  EXPECT_EQ(load(-90.0), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("positions are in rad: -90 degrees would be -1.5708")) << message;
  EXPECT_EQ(load(3.0), ExitStatus::kRefused);
  EXPECT_FALSE(message_has("degrees")) << message;
}

}  // namespace
}  // namespace strainwave
