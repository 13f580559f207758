// SPDX-License-Identifier: BSD-3-Clause
// Every way in which the bus can fail: the reaction, its time, and the recovery. docs/can.md lists them.
#include "tests/drivers/can/cia402/cia402_failure.h"

namespace strainwave::testing {
namespace {

using Cia402BusFailure = Cia402Failure;

TEST_F(Cia402BusFailure, FramesThatNeverComeBackAreForgivenOneAtATimeForEver) {
  for (int i = 0; i < 20; ++i) {
    bench_.can().lose_echoes(i % 3 == 2 ? 1 : 2);
    bench_.run(120, kMoving);
    ASSERT_EQ(bench_.reading().fault, ActuatorFault::kNone)
        << i << ": " << can_detail_text(bench_.reading().drive_error);
  }
  EXPECT_EQ(bench_.bus().counters().frames_dropped, 0);
}

TEST_F(Cia402BusFailure, ALostHeartbeatEchoDoesNotEndTheHeartbeat) {
  bench_.can().lose_echo_of(0x77F);
  const std::int64_t since_ns = bench_.can().now_ns();
  bench_.run(1000, kMoving);
  EXPECT_GE(bench_.frames(0x77F, since_ns).size(), 18U);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

TEST_F(Cia402BusFailure, WhatABusOffSwallowedIsNotWaitedForAfterTheRestart) {
  bench_.can().lose_echoes(100);
  bench_.step(kMoving);
  bench_.step(kMoving);
  bench_.can().lose_echoes(0);
  bench_.can().tell_trouble(CanTrouble::kBusOff);
  bench_.run(20, {0.0, false});
  bench_.can().tell_trouble(CanTrouble::kRestarted);
  bench_.run(5, {0.0, false});
  bench_.clear(300);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone) << can_detail_text(bench_.reading().drive_error);
  EXPECT_TRUE(bench_.enable());
}

// If a link is down for a moment, a drive without a deadline keeps its last torque. The stop must go out at once.
TEST_F(Cia402BusFailure, AnInterfaceThatWasDownForAMomentCarriesTheStopAsSoonAsItIsBack) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("refuse 0x1400 5 0x06090011");
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, kMoving);
  bench.can().set_down();
  bench.run(2, kMoving);
  bench.can().set_up();
  const std::int64_t up_ns = bench.can().now_ns();
  bench.run(3, kMoving);
  EXPECT_EQ(bench.node().drive().power(), can_nodes::PowerState::kQuickStopActive);
  bench.run(50, kMoving);
  for (const CanFrame& order : bench.frames(0x203, up_ns)) {
    EXPECT_EQ(order.bytes[0] & 0x08, 0) << "it is ordered nothing but to stop";
    EXPECT_EQ(little_endian(&order.bytes[2], 2), 0U);
  }
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kConnectionLost);
}

TEST_F(Cia402BusFailure, AnInterfaceThatGoesDownIsAFaultAndNothingOldIsSentWhenItReturns) {
  bench_.can().set_down();
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kConnectionLost, CanDetail::kInterfaceDown);
  bench_.run(300, {0.0, false});
  EXPECT_FALSE(drive_has_torque()) << "the drive's own supervision";
  bench_.can().set_up();
  const std::int64_t up_ns = bench_.can().now_ns();
  bench_.run(100, {0.0, false});
  for (const CanFrame& order : bench_.frames(0x203, up_ns))
    EXPECT_EQ(order.bytes[0] & 0x08, 0) << "no operation before an operator's order";
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kConnectionLost);
  bench_.clear(300);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone) << can_detail_text(bench_.reading().drive_error);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402BusFailure, AClearedFaultStaysWhileTheInterfaceIsDown) {
  bench_.can().set_down();
  bench_.step(kMoving);
  bench_.clear(10);
  expect_fault(ActuatorFault::kConnectionLost, CanDetail::kInterfaceDown);
}

TEST_F(Cia402BusFailure, AnInterfaceThatHasGoneNeverComesBack) {
  bench_.can().set_gone();
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kConnectionLost, CanDetail::kInterfaceGone);
  bench_.can().set_up();
  bench_.clear(10);
  expect_fault(ActuatorFault::kConnectionLost, CanDetail::kInterfaceGone);
}

TEST_F(Cia402BusFailure, ABusThatTakesNoFramesHoldsNoMoreThanTwoPeriodsOfThem) {
  bench_.can().hold(true);
  const int periods = bench_.periods_until_fault(20, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 5);
  bench_.run(1000, {0.0, false});
  EXPECT_LE(bench_.can().held_frames(), 5U) << "an order and a SYNC twice, a heartbeat";
  EXPECT_GT(bench_.bus().counters().frames_dropped, 500);
}

TEST_F(Cia402BusFailure, FramesThatComeBackAPeriodLateAreNoTrouble) {
  bench_.can().set_echo_delay(DriveBench::kPeriod_ns + DriveBench::kPeriod_ns / 2);
  bench_.run(50, kMoving);
  EXPECT_EQ(bench_.bus().counters().frames_dropped, 0);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

TEST_F(Cia402BusFailure, AClearedFaultStaysWhileOldFramesWait) {
  bench_.can().hold(true);
  bench_.run(100, kMoving);
  bench_.clear(5);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kConnectionLost);
  bench_.can().hold(false);
  bench_.run(300, {0.0, false});
  bench_.clear(300);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone) << can_detail_text(bench_.reading().drive_error);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402BusFailure, AFullQueueIsAFaultAndDropsWhatItCannotTake) {
  bench_.can().set_queue_room(0);
  bench_.can().hold(true);
  EXPECT_GT(bench_.periods_until_fault(20, kMoving), 0);
  EXPECT_EQ(bench_.can().held_frames(), 0U);
}

TEST_F(Cia402BusFailure, BusOffIsAFaultUntilTheControllerHasRestarted) {
  bench_.can().tell_trouble(CanTrouble::kBusOff);
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kBusError, CanDetail::kBusOff);
  const std::int64_t since_ns = bench_.can().now_ns();
  bench_.clear(20);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kBusError);
  EXPECT_TRUE(bench_.frames(0x203, since_ns + 1).empty());
  bench_.can().tell_trouble(CanTrouble::kRestarted);
  bench_.run(5, {0.0, false});
  bench_.clear(50);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402BusFailure, ErrorPassiveIsAFaultWhileStoppingStillWorks) {
  bench_.can().tell_trouble(CanTrouble::kErrorPassive);
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kBusError, CanDetail::kErrorPassive);
  EXPECT_EQ(last_controlword(), 0x02U);
  EXPECT_EQ(last_torque(), 0U);
}

TEST_F(Cia402BusFailure, AWarningOfTheControllerIsNone) {
  bench_.can().tell_trouble(CanTrouble::kErrorWarning);
  EXPECT_EQ(bench_.periods_until_fault(10, kMoving), 0);
}

TEST_F(Cia402BusFailure, SomebodyElseWhoSendsOurOrdersIsAFault) {
  bench_.can().send_as_stranger(last_order());
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kWriteRefused, CanDetail::kForeignSender);
  EXPECT_EQ(detail_value_of(bench_.reading().drive_error), 0x203U);
}

TEST_F(Cia402BusFailure, AFloodOfPositionsIsAFaultBeforeTheyGetOld) {
  CanFrame position;
  position.id = 0x183;
  position.size = 8;
  position.bytes[4] = 0x37;
  int periods = 0;
  while (bench_.reading().fault == ActuatorFault::kNone && periods < 100) {
    for (int i = 0; i < 1000; ++i) bench_.can().send_as_stranger(position);
    bench_.step(kMoving);
    ++periods;
  }
  EXPECT_LE(periods, 4);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kBusError);
}

TEST_F(Cia402BusFailure, FramesThatTheKernelLostAreCounted) {
  bench_.can().lose_frames(7);
  bench_.run(2, kMoving);
  EXPECT_EQ(bench_.bus().counters().frames_lost, 7);
  bench_.run(20, kMoving);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

}  // namespace
}  // namespace strainwave::testing
