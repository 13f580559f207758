// SPDX-License-Identifier: BSD-3-Clause
// Drives that close their own position or velocity loop: the checks at start-up and the orders in the loop.
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/can/can_detail.h"
#include "tests/drivers/can/cia402/own_loop_drive.h"

namespace strainwave::testing {
namespace {

constexpr double kInitial_rad = kOwnLoopInitial_rad;
constexpr double kCount_rad = kOwnLoopCount_rad;

TEST(Cia402OwnLoop, StartUpTakesTheModeThatTheConfigurationWants) {
  for (const auto& [mode, text] :
       {std::pair{DriveMode::kPosition, "mode 8 (CSP)"}, std::pair{DriveMode::kVelocity, "mode 9 (CSV)"}}) {
    OwnLoop joint(own_loop(mode));
    expect_mentions(joint.bench.said(), {text, "rated 9.6 N.m"});
    EXPECT_EQ(joint.bench.reading().fault, ActuatorFault::kNone);
  }
  BenchDrive interpolates = own_loop(DriveMode::kPosition);
  interpolates.node.drive.has_csp = false;
  interpolates.node.drive.has_ip = true;
  OwnLoop joint(interpolates);
  expect_mentions(joint.bench.said(), {"mode 7 (IP)"});
  EXPECT_LT(joint.largest_error_rad(0.5, 300), 0.005) << "it follows 60C1h:01, and is told so by bit 4";
}

TEST(Cia402OwnLoop, ADriveWithoutTheModeIsRefusedWithTheOneThatItHas) {
  BenchDrive drive = own_loop(DriveMode::kPosition);
  drive.node.drive.has_csp = false;
  expect_mentions(DriveBench({drive}).start_refusal(),
                  {"6502h", "CSP (mode 8)", "IP (mode 7)", "drive_mode = \"velocity\" is possible"});
  drive.config.drive_mode = DriveMode::kTorque;
  expect_mentions(DriveBench({drive}).start_refusal(), {"CST (mode 10)", "TQ (mode 4)"});
}

TEST(Cia402OwnLoop, StandsWhereItIsWhileItIsEnabled) {
  for (const bool reversed : {false, true}) {
    BenchDrive drive = own_loop(DriveMode::kPosition);
    if (reversed) {
      drive.node.drive.joint_torque_per_drive_torque *= -1.0;
      drive.config.units.direction = -1;
    }
    OwnLoop joint(drive);
    for (int i = 0; i < 100; ++i) joint.hold();
    EXPECT_NEAR(joint.position_rad(), kInitial_rad, kCount_rad) << reversed;
    EXPECT_NEAR(joint.bench.reading().joint_position_rad, kInitial_rad, kCount_rad);
  }
}

TEST(Cia402OwnLoop, ArrivesAtTheEndOfTheOrdersPeriodWithVelocityFedForward) {
  OwnLoop joint(own_loop(DriveMode::kPosition));
  const double with_rad = joint.largest_error_rad(1.0, 600);
  BenchDrive drive = own_loop(DriveMode::kPosition);
  drive.config.units.velocity_rad_s_per_unit = 0.0;
  OwnLoop without(drive);
  EXPECT_TRUE(without.bench.frames(0x303, 0).empty());
  EXPECT_LT(with_rad, 1e-3) << "a period's way";
  EXPECT_GT(without.largest_error_rad(1.0, 600), 5.0 * with_rad);
}

TEST(Cia402OwnLoop, TurnsAtTheVelocityThatItIsOrdered) {
  OwnLoop joint(own_loop(DriveMode::kVelocity));
  for (int i = 0; i < 500; ++i) joint.bench.step({0.0, true, 0.0, -0.8});
  EXPECT_NEAR(joint.bench.node().drive().plant().state().velocity_rad_s, -0.8, 0.05);
  EXPECT_TRUE(joint.bench.reading().torque_measured);
  EXPECT_LT(joint.bench.reading().torque_applied_Nm, 0.0) << "friction, by 6077h";
}

TEST(Cia402OwnLoop, TakesTheTorqueThatIsFedForward) {
  OwnLoop joint(own_loop(DriveMode::kPosition));
  joint.bench.step({3.0, true, joint.bench.reading().joint_position_rad, 0.0});
  joint.bench.step({3.0, true, joint.bench.reading().joint_position_rad, 0.0});
  EXPECT_NEAR(joint.bench.node().drive().torque_demand_Nm(), 3.0, 0.5);
}

TEST(Cia402OwnLoop, DoesWithoutWhatADriveNeedNotHave) {
  BenchDrive drive = own_loop(DriveMode::kPosition);
  drive.node.lacks = {0x6071, 0x60B1, 0x60B2, 0x605A, 0x6065, 0x6077};
  OwnLoop joint(drive);
  expect_mentions(joint.bench.said(), {"60B1h", "60B2h", "605Ah", "6065h", "6077h"});
  EXPECT_FALSE(joint.bench.reading().torque_measured);
  EXPECT_LT(joint.largest_error_rad(0.2, 400), 0.01);

  drive = own_loop(DriveMode::kPosition);
  drive.node.lacks = {0x6075, 0x6076};
  OwnLoop without_unit(drive);
  expect_mentions(without_unit.bench.said(), {"no 6076h", "sends it no torque"});
  EXPECT_FALSE(without_unit.bench.reading().torque_measured);
}

TEST(Cia402OwnLoop, StopsAlongTheDrivesRamp) {
  OwnLoop joint(own_loop(DriveMode::kPosition));
  EXPECT_EQ(joint.bench.node().dictionary().number({0x605A, 0}), 2);
  (void)joint.largest_error_rad(2.0, 200);
  joint.bench.tell_node("emcy 0x4310");
  const double from_rad = joint.position_rad();
  EXPECT_EQ(joint.bench.periods_until_fault(5, {0.0, true, from_rad, 2.0}), 1);
  EXPECT_EQ(joint.controlword(), 0x02U);
  joint.bench.run(500, {0.0, true, from_rad, 2.0});
  EXPECT_LT(joint.position_rad() - from_rad, 0.2);
  EXPECT_LT(std::abs(joint.bench.node().drive().plant().state().velocity_rad_s), 1e-3);
  EXPECT_EQ(joint.bench.node().drive().torque_demand_Nm(), 0.0);
}

TEST(Cia402OwnLoop, KeepsItsLastOrderWhilePositionsStayAwayAndThenStops) {
  OwnLoop joint(own_loop(DriveMode::kPosition));
  const double place_rad = joint.bench.reading().joint_position_rad;
  const ActuatorCommand order{0.0, true, place_rad + 0.01, 0.0};
  joint.bench.run(200, order);
  joint.bench.tell_node("skip-tpdo 1000");
  joint.bench.run(joint.bench.config().quick_stop_after, order);
  EXPECT_EQ(little_endian(&joint.bench.frames(0x203, 0).back().bytes[2], 4),
            static_cast<std::uint64_t>(std::llround((place_rad + 0.01) / kCount_rad)));
  EXPECT_GT(joint.bench.periods_until_fault(3, order), 0);
  EXPECT_EQ(detail_of(joint.bench.reading().drive_error), CanDetail::kPositionMissing);
  EXPECT_EQ(joint.controlword(), 0x02U);
}

TEST(Cia402OwnLoop, TheDrivesOwnFollowingErrorIsItsFault) {
  BenchDrive drive = own_loop(DriveMode::kPosition);
  DriveBench told({drive});
  told.node().dictionary().set({0x6065, 0}, 2000);
  told.start();
  expect_mentions(told.said(), {"0.0392", "6065h", "following_error_rad = 0.1"});
  OwnLoop joint(drive);
  joint.bench.node().dictionary().set({0x6065, 0}, 2000);
  const double far_rad = kInitial_rad + 0.2;
  ASSERT_GT(joint.bench.periods_until_fault(10, {0.0, true, far_rad, 0.0}), 0);
  EXPECT_EQ(joint.bench.reading().fault, ActuatorFault::kDriveFault);
  EXPECT_EQ(joint.bench.reading().drive_error & 0xFFFFU, 0x8611U);
}

}  // namespace
}  // namespace strainwave::testing
