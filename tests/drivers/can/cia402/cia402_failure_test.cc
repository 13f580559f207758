// Every way in which drive and bus can fail: the reaction, its time, and the way back. docs/can.md lists
// them.
#include <gtest/gtest.h>

#include <limits>

#include "drivers/can/can_detail.h"
#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

class Cia402Failure : public ::testing::Test {
 protected:
  Cia402Failure() {
    bench_.start();
    EXPECT_TRUE(bench_.enable());
    bench_.run(50, kMoving);
  }
  void expect_fault(ActuatorFault fault, CanDetail detail) {
    EXPECT_EQ(bench_.reading().fault, fault);
    EXPECT_EQ(detail_of(bench_.reading().drive_error), detail)
        << can_detail_text(bench_.reading().drive_error);
  }
  /// The last controlword and torque that the drive was sent.
  std::uint64_t last_controlword() { return little_endian(last_order().bytes.data(), 2); }
  std::uint64_t last_torque() { return little_endian(&last_order().bytes[2], 2); }
  CanFrame last_order() { return bench_.frames(0x203, 0).back(); }
  bool drive_has_torque() { return bench_.node().drive().torque_demand_Nm() != 0.0; }

  static constexpr ActuatorCommand kMoving{10.0, true};
  DriveBench bench_{{bench_drive(3)}};
};

TEST_F(Cia402Failure, AnEmergencyStopsAtOnceAndSaysWhy) {
  bench_.tell_node("emcy 0x4310");
  EXPECT_EQ(bench_.periods_until_fault(3, kMoving), 1);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kDriveFault);
  EXPECT_EQ(cia402::drive_error_text(bench_.reading().drive_error),
            "emergency 4310h, drive temperature: too hot (register 09h)");
  EXPECT_EQ(last_torque(), 0U);
  bench_.run(1000, kMoving);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kDriveFault) << "latched";
  bench_.clear();
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, AnEmergencyAboutTheSupplyIsAPowerFault) {
  bench_.tell_node("emcy 0x3220");
  EXPECT_EQ(bench_.periods_until_fault(3, kMoving), 1);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kPowerLost);
}

TEST_F(Cia402Failure, MissingPositionsTakeTheTorqueThenStopTheDrive) {
  const cia402::DriveConfig& config = bench_.config();
  bench_.tell_node("skip-tpdo 1000");
  for (int missed = 0; missed <= config.zero_torque_after; ++missed) {
    bench_.step(kMoving);
    EXPECT_NE(last_torque(), 0U) << missed;
  }
  bench_.step(kMoving);
  EXPECT_EQ(last_torque(), 0U);
  EXPECT_EQ(last_controlword(), 0x0FU) << "enabled still";
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  const int more = bench_.periods_until_fault(10, kMoving);
  EXPECT_EQ(config.zero_torque_after + 1 + more, config.quick_stop_after + 1);
  expect_fault(ActuatorFault::kReadFailed, CanDetail::kPositionMissing);
  EXPECT_EQ(last_controlword(), 0x02U);
}

TEST_F(Cia402Failure, PositionsThatStayLateAreAFaultThoughOneComesInEveryPeriod) {
  for (const char* late : {"late-tpdo 2400 100000", "late-tpdo 10400 100000"}) {
    DriveBench bench({bench_drive(3)});
    bench.config().quick_stop_after = 20;  // the gap at the beginning alone would be a fault
    bench.config().zero_torque_after = 2;
    bench.start();
    ASSERT_TRUE(bench.enable());
    bench.run(50, kMoving);
    bench.tell_node(late);
    const int periods = bench.periods_until_fault(100, kMoving);
    EXPECT_GT(periods, 0) << late;
    EXPECT_LE(periods, 20) << late;
    EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
        << can_detail_text(bench.reading().drive_error);
  }
}

TEST_F(Cia402Failure, WholePeriodsOfLatenessAreSeenThoughThePlaceInThePeriodIsTheUsual) {
  DriveBench bench({bench_drive(3)});
  bench.config().quick_stop_after = 20;  // the gap at the beginning alone would be a fault
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, kMoving);
  bench.tell_node("late-tpdo 3000 100000");
  const int periods = bench.periods_until_fault(100, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 45) << "three TPDO2 of ten periods, and what they are late by";
  EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
      << can_detail_text(bench.reading().drive_error);
  // Nothing is late any more once the drive was set up anew.
  bench.tell_node("late-tpdo 0 0");
  bench.run(50, {0.0, false});
  bench.clear();
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench.enable());
  bench.run(100, kMoving);
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_EQ(bench.reading().position_late_periods, 0);
}

TEST_F(Cia402Failure, APositionThatIsLateWithinDelayPeriodsIsToldWithItsDelayAndIsNoFault) {
  for (const auto& [late, delay_ms, periods] :
       {std::tuple{"late-tpdo 1400 100000", 1.4, 1}, std::tuple{"late-tpdo 2400 100000", 2.4, 2},
        std::tuple{"late-tpdo 2000 100000", 2.0, 2}}) {
    DriveBench bench({bench_drive(3)});
    bench.config().delay_periods = 3;
    bench.config().quick_stop_after = 20;
    bench.start();
    ASSERT_TRUE(bench.enable());
    bench.run(50, kMoving);
    EXPECT_EQ(bench.reading().position_late_periods, 0);
    EXPECT_LT(bench.reading().position_delay_ns, DriveBench::kPeriod_ns);
    bench.tell_node(late);
    EXPECT_EQ(bench.periods_until_fault(200, kMoving), 0) << late;
    EXPECT_EQ(bench.reading().position_late_periods, periods) << late;
    EXPECT_NEAR(static_cast<double>(bench.reading().position_delay_ns) * 1e-6, delay_ms, 0.2) << late;
  }
}

TEST_F(Cia402Failure, ADelayThatADriveHasFromTheStartIsPartOfDelayPeriods) {
  DriveBench bench({bench_drive(3)});
  bench.config().delay_periods = 3;
  bench.tell_node("late-tpdo 2400 100000");
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(200, kMoving);
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_EQ(bench.reading().position_late_periods, 0);
  EXPECT_NEAR(static_cast<double>(bench.reading().position_delay_ns) * 1e-6, 2.4, 0.2);
}

TEST_F(Cia402Failure, ADriveWhosePositionsAreLateFromTheStartIsRefusedWithTheirDelay) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("late-tpdo 2400 100000");
  const std::string text = bench.start_refusal();
  EXPECT_NE(text.find("2.4"), std::string::npos) << text;
  EXPECT_NE(text.find("delay_periods = 1"), std::string::npos) << text;
}

TEST_F(Cia402Failure, AFewMissingPositionsAreCountedAndForgiven) {
  bench_.tell_node("skip-tpdo 2");
  bench_.step(kMoving);
  bench_.step(kMoving);
  bench_.step(kMoving);
  EXPECT_FALSE(bench_.reading().has_position);
  bench_.run(10, kMoving);
  EXPECT_TRUE(bench_.reading().has_position);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  EXPECT_NE(last_torque(), 0U);
}

TEST_F(Cia402Failure, AnUnexpectedBootUpIsAFaultAndClearingSetsTheDriveUpAgain) {
  bench_.tell_node("reboot 100");
  // Silence is noticed first: the node is out for longer than positions may be missing.
  EXPECT_GT(bench_.periods_until_fault(10, kMoving), 0);
  bench_.run(150, {0.0, false});
  bench_.clear();
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench_.reading().has_position);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, ABootUpAloneIsAFaultInTheSamePeriod) {
  CanFrame boot_up;
  boot_up.id = 0x703;
  boot_up.size = 1;
  bench_.can().send_as_stranger(boot_up);
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kDriveRestarted, CanDetail::kBootUp);
}

// The torque afterwards: tests/adversary/foreign_nmt_master.cc.
TEST_F(Cia402Failure, ADriveThatLeavesTheOperationalStateIsAFault) {
  CanFrame order;
  order.size = 2;
  order.bytes = {0x80, 3};
  bench_.can().send_as_stranger(order);
  const int periods = bench_.periods_until_fault(100, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 60) << "a heartbeat period, or the missing positions";
}

TEST_F(Cia402Failure, ADriveThatDoesNotFollowItsTorqueIsAFault) {
  bench_.tell_node("pretend 0x6041 0 0x0237");  // operation enabled, bit 12 not set
  const int periods = bench_.periods_until_fault(100, kMoving);
  EXPECT_GE(periods, 20);
  EXPECT_LE(periods, 25);
  expect_fault(ActuatorFault::kDriveFault, CanDetail::kNotFollowing);
}

TEST_F(Cia402Failure, ARestartedDriveLosesItsPositionUnlessItsEncoderIsAbsolute) {
  for (const bool absolute : {true, false}) {
    BenchDrive drive = bench_drive(3);
    drive.config.absolute_encoder = absolute;
    DriveBench bench({drive});
    bench.start();
    ASSERT_TRUE(bench.enable());
    EXPECT_FALSE(bench.reading().position_lost);
    bench.tell_node("reboot 100");
    bool lost = false;
    for (int i = 0; i < 300; ++i) {
      bench.step({0.0, false});
      lost = lost || bench.reading().position_lost;
    }
    EXPECT_EQ(lost, !absolute);
    bench.clear();
    bench.run(5, {0.0, false});
    EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
    EXPECT_FALSE(bench.reading().position_lost) << "it may be homed again";
  }
}

TEST_F(Cia402Failure, ShowsTheInputsThatAreWiredAndNoOthers) {
  BenchDrive drive = bench_drive(3);
  drive.config.inputs.negative_limit = true;
  drive.config.inputs.home = true;
  DriveBench bench({drive});
  bench.start();
  bench.run(20, {0.0, false});
  EXPECT_FALSE(bench.reading().inputs.negative_limit || bench.reading().inputs.home);
  bench.tell_node("pretend 0x60FD 0 0xFFFF0007");
  bench.run(20, {0.0, false});
  EXPECT_TRUE(bench.reading().inputs.negative_limit);
  EXPECT_TRUE(bench.reading().inputs.home);
  EXPECT_FALSE(bench.reading().inputs.positive_limit);
}

TEST_F(Cia402Failure, FramesThatNeverComeBackAreForgivenOneAtATimeForEver) {
  for (int i = 0; i < 20; ++i) {
    bench_.can().lose_echoes(i % 3 == 2 ? 1 : 2);
    bench_.run(120, kMoving);
    ASSERT_EQ(bench_.reading().fault, ActuatorFault::kNone)
        << i << ": " << can_detail_text(bench_.reading().drive_error);
  }
  EXPECT_EQ(bench_.bus().counters().frames_dropped, 0);
}

TEST_F(Cia402Failure, ALostHeartbeatEchoDoesNotEndTheHeartbeat) {
  bench_.can().lose_echo_of(0x77F);
  const std::int64_t since_ns = bench_.can().now_ns();
  bench_.run(1000, kMoving);
  EXPECT_GE(bench_.frames(0x77F, since_ns).size(), 18U);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

TEST_F(Cia402Failure, WhatABusOffSwallowedIsNotWaitedForAfterTheRestart) {
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

TEST_F(Cia402Failure, AMissingHeartbeatIsAFaultAfterItsTimeOut) {
  bench_.tell_node("heartbeat off");
  const int periods = bench_.periods_until_fault(300, kMoving);
  EXPECT_GE(periods, 100);
  EXPECT_LE(periods, 151);
  expect_fault(ActuatorFault::kLinkLost, CanDetail::kHeartbeatMissing);
  bench_.tell_node("heartbeat on");
  bench_.run(200, {0.0, false});
  bench_.clear();
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, AnotherModeThanTheOrderedOneIsAFault) {
  bench_.tell_node("pretend 0x6061 0 8");
  const int periods = bench_.periods_until_fault(100, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 11) << "the slow TPDO's period";
  expect_fault(ActuatorFault::kWriteRefused, CanDetail::kWrongMode);
}

TEST_F(Cia402Failure, ADriveThatNeverEnablesIsAFaultThatNamesItsState) {
  DriveBench bench({bench_drive(3)});
  bench.node().dictionary().set({0x6041, 0}, 0);
  bench.start();
  bench.run(5, {0.0, false});
  bench.tell_node("pretend 0x6041 0 0x0231");
  const int periods = bench.periods_until_fault(1000, {0.0, true});
  EXPECT_GE(periods, 500);
  EXPECT_LE(periods, 510);
  EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kEnableStep);
  EXPECT_EQ(detail_value_of(bench.reading().drive_error), 0x0231U);
}

TEST_F(Cia402Failure, ADriveThatLeavesOperationByItselfIsAFault) {
  bench_.tell_node("pretend 0x6041 0 0x0250");
  EXPECT_LE(bench_.periods_until_fault(5, kMoving), 2);
  expect_fault(ActuatorFault::kDriveFault, CanDetail::kLeftOperation);
  EXPECT_EQ(last_torque(), 0U);
}

TEST_F(Cia402Failure, ADriveThatLosesItsSupplyIsAPowerFault) {
  bench_.tell_node("pretend 0x6041 0 0x0240");
  EXPECT_LE(bench_.periods_until_fault(5, kMoving), 2);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kPowerLost);
}

TEST_F(Cia402Failure, AnInterfaceThatGoesDownIsAFaultAndNothingOldIsSentWhenItReturns) {
  bench_.can().set_down();
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kLinkLost, CanDetail::kInterfaceDown);
  bench_.run(300, {0.0, false});
  EXPECT_FALSE(drive_has_torque()) << "the drive's own supervision";
  bench_.can().set_up();
  const std::int64_t up_ns = bench_.can().now_ns();
  bench_.run(100, {0.0, false});
  EXPECT_TRUE(bench_.frames(0x203, up_ns).empty()) << "nothing before an operator's order";
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kLinkLost);
  bench_.clear(300);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone) << can_detail_text(bench_.reading().drive_error);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, AClearedFaultStaysWhileTheInterfaceIsDown) {
  bench_.can().set_down();
  bench_.step(kMoving);
  bench_.clear(10);
  expect_fault(ActuatorFault::kLinkLost, CanDetail::kInterfaceDown);
}

TEST_F(Cia402Failure, AnInterfaceThatHasGoneNeverComesBack) {
  bench_.can().set_gone();
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kLinkLost, CanDetail::kInterfaceGone);
  bench_.can().set_up();
  bench_.clear(10);
  expect_fault(ActuatorFault::kLinkLost, CanDetail::kInterfaceGone);
}

TEST_F(Cia402Failure, ABusThatTakesNoFramesHoldsNoMoreThanTwoPeriodsOfThem) {
  bench_.can().hold(true);
  const int periods = bench_.periods_until_fault(20, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 5);
  bench_.run(1000, {0.0, false});
  EXPECT_LE(bench_.can().held_frames(), 5U) << "an order and a SYNC twice, a heartbeat";
  EXPECT_GT(bench_.bus().counters().frames_dropped, 500);
}

TEST_F(Cia402Failure, FramesThatComeBackAPeriodLateAreNoTrouble) {
  bench_.can().set_echo_delay(DriveBench::kPeriod_ns + DriveBench::kPeriod_ns / 2);
  bench_.run(50, kMoving);
  EXPECT_EQ(bench_.bus().counters().frames_dropped, 0);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

TEST_F(Cia402Failure, AClearedFaultStaysWhileOldFramesWait) {
  bench_.can().hold(true);
  bench_.run(100, kMoving);
  bench_.clear(5);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kLinkLost);
  bench_.can().hold(false);
  bench_.run(300, {0.0, false});
  bench_.clear(300);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone) << can_detail_text(bench_.reading().drive_error);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, AFullQueueIsAFaultAndDropsWhatItCannotTake) {
  bench_.can().set_queue_room(0);
  bench_.can().hold(true);
  EXPECT_GT(bench_.periods_until_fault(20, kMoving), 0);
  EXPECT_EQ(bench_.can().held_frames(), 0U);
}

TEST_F(Cia402Failure, BusOffIsAFaultUntilTheControllerHasRestarted) {
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

TEST_F(Cia402Failure, ErrorPassiveIsAFaultWhileStoppingStillWorks) {
  bench_.can().tell_trouble(CanTrouble::kErrorPassive);
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kBusError, CanDetail::kErrorPassive);
  EXPECT_EQ(last_controlword(), 0x02U);
  EXPECT_EQ(last_torque(), 0U);
}

TEST_F(Cia402Failure, AWarningOfTheControllerIsNone) {
  bench_.can().tell_trouble(CanTrouble::kErrorWarning);
  EXPECT_EQ(bench_.periods_until_fault(10, kMoving), 0);
}

TEST_F(Cia402Failure, SomebodyElseWhoSendsOurOrdersIsAFault) {
  bench_.can().send_as_stranger(last_order());
  EXPECT_EQ(bench_.periods_until_fault(2, kMoving), 1);
  expect_fault(ActuatorFault::kWriteRefused, CanDetail::kForeignSender);
  EXPECT_EQ(detail_value_of(bench_.reading().drive_error), 0x203U);
}

TEST_F(Cia402Failure, AFloodOfPositionsIsAFaultBeforeTheyGetOld) {
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

TEST_F(Cia402Failure, FramesThatTheKernelLostAreCounted) {
  bench_.can().lose_frames(7);
  bench_.run(2, kMoving);
  EXPECT_EQ(bench_.bus().counters().frames_lost, 7);
  bench_.run(20, kMoving);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
}

TEST_F(Cia402Failure, FramesOfAnotherSizeAreNoPositions) {
  CanFrame position;
  position.id = 0x183;
  position.bytes = {1, 2, 3, 4, 5, 6, 7, 0};
  const double before_rad = bench_.reading().joint_position_rad;
  bench_.tell_node("skip-tpdo 1");
  position.size = 7;
  bench_.step(kMoving);
  bench_.can().send_as_stranger(position);
  bench_.step(kMoving);
  EXPECT_FALSE(bench_.reading().has_position);
  EXPECT_NEAR(bench_.reading().joint_position_rad, before_rad, 0.1);
}

TEST_F(Cia402Failure, ATorqueThatIsNoNumberIsNeverSent) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    bench_.step({bad, true});
    EXPECT_EQ(last_torque(), 0U);
  }
  bench_.step(kMoving);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kWriteRefused);
}

TEST_F(Cia402Failure, StopTakesTheTorqueInTheSamePeriod) {
  bench_.actuator().stop();
  bench_.step({0.0, false});
  EXPECT_EQ(last_torque(), 0U);
  EXPECT_EQ(last_controlword(), 0x02U);
  for (int i = 0; i < 2000 && bench_.reading().drive_state != DriveState::kDisabled; ++i)
    bench_.step({0.0, false});
  EXPECT_EQ(bench_.reading().drive_state, DriveState::kDisabled);
  EXPECT_TRUE(bench_.enable());
}

TEST_F(Cia402Failure, OneDriveThatFailsLeavesTheOthersAlone) {
  DriveBench bench({bench_drive(1), bench_drive(2)});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.tell_node("cut", 0);
  bench.run(300, kMoving);
  EXPECT_NE(bench.reading(0).fault, ActuatorFault::kNone);
  EXPECT_EQ(bench.reading(1).fault, ActuatorFault::kNone);
  EXPECT_NEAR(bench.node(1).drive().torque_demand_Nm(), 10.0, 0.005);
}

}  // namespace
}  // namespace strainwave::testing
