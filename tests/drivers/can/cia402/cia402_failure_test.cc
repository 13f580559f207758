// SPDX-License-Identifier: BSD-3-Clause
// Every way in which a drive can fail: the reaction, its time, and the recovery. docs/can.md lists them.
#include <limits>

#include "tests/drivers/can/cia402/cia402_failure.h"

namespace strainwave::testing {
namespace {

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
  // The driver notices the missing positions before it sees the boot-up message.
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

// tests/adversary/foreign_nmt_master.cc checks the torque afterwards.

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

TEST_F(Cia402Failure, AMissingHeartbeatIsAFaultAfterItsTimeOut) {
  bench_.tell_node("heartbeat off");
  const int periods = bench_.periods_until_fault(300, kMoving);
  EXPECT_GE(periods, 100);
  EXPECT_LE(periods, 151);
  expect_fault(ActuatorFault::kConnectionLost, CanDetail::kHeartbeatMissing);
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
