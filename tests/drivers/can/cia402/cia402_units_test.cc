// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "drivers/can/bus_load.h"
#include "drivers/can/cia402/cia402_config.h"
#include "tests/support/refusal.h"

namespace strainwave::cia402 {
namespace {

UnitConfig motor_units() {
  UnitConfig units;
  units.counts_per_output_revolution = 320000;
  units.gear_ratio = 50;
  units.torque_constant_Nm_A = 0.192;
  return units;
}

std::string refusal(const RatedValues& rated, const UnitConfig& units) {
  return testing::refusal_of([&] { rated_joint_torque_Nm(rated, units, "elbow"); });
}

TEST(RatedTorque, IsTakenToTheJoint) {
  EXPECT_NEAR(rated_joint_torque_Nm({192, 1000}, motor_units(), "elbow"), 9.6, 1e-12);
  UnitConfig units = motor_units();
  units.torque_at_joint = true;
  EXPECT_NEAR(rated_joint_torque_Nm({9600, 1000}, units, "elbow"), 9.6, 1e-12);
  units = motor_units();
  units.rated_torque_unit_Nm = 1e-6;
  EXPECT_NEAR(rated_joint_torque_Nm({192000, 1000}, units, "elbow"), 9.6, 1e-12);
}

TEST(RatedTorque, InTheOtherUnitIsRefusedWithTheUnitThatWouldFit) {
  const std::string text = refusal({192000, 1000}, motor_units());
  EXPECT_NE(text.find("rated_torque_unit = \"uNm\""), std::string::npos) << text;
  EXPECT_NE(text.find("would agree"), std::string::npos) << text;
  UnitConfig units = motor_units();
  units.rated_torque_unit_Nm = 1e-6;
  EXPECT_NE(refusal({192, 1000}, units).find("rated_torque_unit = \"mNm\""), std::string::npos);
}

TEST(RatedTorque, OnTheOtherSideOfTheGearIsRefusedWithTheSideThatWouldFit) {
  EXPECT_NE(refusal({9600, 1000}, motor_units()).find("torque_side = \"joint\""), std::string::npos);
}

TEST(RatedTorque, ThatNothingExplainsIsRefused) {
  EXPECT_NE(refusal({19, 1000}, motor_units()).find("no unit makes them agree"), std::string::npos);
  EXPECT_NE(refusal({0, 0}, motor_units()), "accepted");
  EXPECT_NE(refusal({0, 1000}, motor_units()), "accepted");
}

TEST(VelocityUnit, IsComparedWithTheDrivesOnEitherSideOfTheGear) {
  constexpr std::uint32_t kTenthRpm = 0xFFB44700;
  UnitConfig units = motor_units();
  const double rpm_rad_s = 2.0 * std::numbers::pi / 60.0;
  const auto text_of = [&](std::uint32_t unit) { return velocity_unit_text(unit, units, "elbow"); };
  units.velocity_rad_s_per_unit = 0.1 * rpm_rad_s / 50.0;
  testing::expect_mentions(text_of(kTenthRpm), {"0.1 rev/min", "at the motor"});
  units.velocity_rad_s_per_unit = 0.1 * rpm_rad_s;
  testing::expect_mentions(text_of(kTenthRpm), {"at the joint"});
  units.velocity_rad_s_per_unit = 1e-3 * 2.0 * std::numbers::pi / 360.0;
  testing::expect_mentions(text_of(0xFD410300), {"0.001 deg/s", "at the joint"});
  units.velocity_rad_s_per_unit = rpm_rad_s / 50.0;
  testing::expect_mentions(
      testing::refusal_of([&] { text_of(kTenthRpm); }),
      {"velocity_rad_s_per_unit = 0.00209439", "FFB44700h", "0.000209439", "the motor's"});
}

TEST(VelocityUnit, ThatTheDriveDoesNotSayIsTakenFromTheConfiguration) {
  UnitConfig units = motor_units();
  units.velocity_rad_s_per_unit = 0.5;
  testing::expect_mentions(velocity_unit_text(0, units, "elbow"), {"0.5 is used", "does not give its unit"});
  testing::expect_mentions(velocity_unit_text(0x00770300, units, "elbow"),
                           {"0.5 is used", "00770300h", "does not know"});
}

TEST(RatedTorque, AllowsForPeakAndRmsAmperes) {
  EXPECT_EQ(refusal({192, 1414}, motor_units()), "accepted");
  EXPECT_EQ(refusal({192, 707}, motor_units()), "accepted");
  EXPECT_NE(refusal({192, 2000}, motor_units()), "accepted");
}

TEST(TorqueScale, RoundsToThousandthsOfRatedTorqueWithTheDrivesSign) {
  const TorqueScale forward(9.6, 1, 20.0);
  const TorqueScale reversed(9.6, -1, 20.0);
  EXPECT_EQ(forward.per_mille(9.6), 1000);
  EXPECT_EQ(reversed.per_mille(9.6), -1000);
  EXPECT_EQ(forward.per_mille(0.0049), 1);
  EXPECT_EQ(forward.per_mille(0.0047), 0);
  EXPECT_NEAR(reversed.torque_Nm(-500), 4.8, 1e-12);
}

TEST(TorqueScale, NeverExceedsItsLimitNorSendsWhatIsNoNumber) {
  const TorqueScale scale(9.6, 1, 20.0);
  EXPECT_EQ(scale.limit_per_mille(), 2083);
  EXPECT_LE(scale.torque_Nm(static_cast<std::int16_t>(scale.limit_per_mille())), 20.0);
  EXPECT_EQ(scale.per_mille(1e6), 2083);
  EXPECT_EQ(scale.per_mille(-1e300), -2083);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(scale.per_mille(bad), 0);
  EXPECT_EQ(TorqueScale(1e-3, 1, 1e6).limit_per_mille(), INT16_MAX) << "6071h holds no more";
}

TEST(PositionScale, CountsOnWhenTheCounterWraps) {
  PositionScale scale(motor_units());
  const double start_rad = scale.position_rad(INT32_MAX - 10);
  EXPECT_NEAR(scale.position_rad(INT32_MIN + 9) - start_rad, 20 * 2 * std::numbers::pi / 320000, 1e-9);
  EXPECT_NEAR(scale.position_rad(INT32_MAX - 10), start_rad, 1e-9) << "and back";
}

TEST(PositionScale, TurnsWithTheJointAndFromItsZero) {
  UnitConfig units = motor_units();
  units.direction = -1;
  units.position_offset_rad = 0.5;
  PositionScale scale(units);
  EXPECT_NEAR(scale.position_rad(80000), 0.5 - std::numbers::pi / 2, 1e-12);
}

TEST(TemperatureObject, IsReadWithItsTypeScaleAndOffset) {
  TemperatureObject object;
  object.scale_C = 0.1;
  EXPECT_NEAR(temperature_C(object, 0xFF9C), -10.0, 1e-12) << "INT16, a tenth of a degree";
  object.type = NumberType::kReal32;
  object.scale_C = 1.0;
  EXPECT_NEAR(temperature_C(object, 0x41CC0000), 25.5, 1e-6);
  object.type = NumberType::kUint8;
  object.offset_C = -40.0;
  EXPECT_NEAR(temperature_C(object, 65), 25.0, 1e-12);
}

// The longest frame with worst-case bit stuffing: a stuff bit after five equal bits, then after every four more.
TEST(BusLoad, HasTheWorstStuffingOfTheLiterature) {
  EXPECT_EQ(worst_case_frame_bits(8), 135);
  EXPECT_EQ(worst_case_frame_bits(4), 95);
  EXPECT_EQ(worst_case_frame_bits(0), 55);
}

TEST(BusLoad, AddsUpAndIsRefusedAboveItsLimit) {
  const std::vector<FrameTraffic> joint{{"SYNC", 0, 1000.0}, {"RPDO1", 4, 1000.0}, {"TPDO1", 8, 1000.0}};
  EXPECT_NEAR(bus_load(joint, 1e6), 0.285, 1e-12);
  EXPECT_NO_THROW(require_bus_load("can0", joint, 1e6, 0.3));
  const std::string text = testing::refusal_of([&] { require_bus_load("can0", joint, 500e3, 0.5); });
  EXPECT_NE(text.find("57.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("load_limit = 0.50"), std::string::npos) << text;
}

}  // namespace
}  // namespace strainwave::cia402
