// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/odrive/odrive.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "drivers/can/odrive/odrive_config.h"

namespace strainwave::odrive {
namespace {

CanFrame frame_of(std::initializer_list<std::uint8_t> bytes) {
  CanFrame frame;
  for (const std::uint8_t byte : bytes) frame.bytes[frame.size++] = byte;
  return frame;
}

CanFrame pair_of(float first, float second) {
  CanFrame frame;
  frame.size = 8;
  put_little_endian(&frame.bytes[0], 4, std::bit_cast<std::uint32_t>(first));
  put_little_endian(&frame.bytes[4], 4, std::bit_cast<std::uint32_t>(second));
  return frame;
}

TEST(Odrive, NumbersItsFramesByNodeAndCommand) {
  EXPECT_EQ(can_id(Command::kVersion, 0), 0x000U);
  EXPECT_EQ(can_id(Command::kSetTorque, 1), 0x02EU);
  EXPECT_EQ(can_id(Command::kClearErrors, 63), 0x7F8U);
}

TEST(Odrive, EncodesOrdersAsTheDocumentationPrintsThem) {
  EXPECT_EQ(axis_state_frame(1, AxisState::kClosedLoop).payload().size(), 4U);
  EXPECT_EQ(axis_state_frame(1, AxisState::kClosedLoop).bytes[0], 8);
  const CanFrame mode = mode_frame(1, ControlMode::kTorque);
  EXPECT_EQ(mode.size, 8);
  EXPECT_EQ(mode.bytes[0], 1);
  EXPECT_EQ(mode.bytes[4], 1);
  const CanFrame torque = torque_frame(1, -0.5);
  EXPECT_EQ(torque.size, 4);
  EXPECT_EQ(little_endian(torque.bytes.data(), 4), 0xBF000000U);
  EXPECT_TRUE(request_frame(1, Command::kVersion).remote);
  EXPECT_EQ(request_frame(1, Command::kVersion).size, 0);
}

TEST(Odrive, DecodesVersionAndHeartbeat) {
  const auto version = decode_version(frame_of({2, 4, 4, 58, 0, 6, 10, 0}));
  ASSERT_TRUE(version);
  EXPECT_EQ(version->firmware_major, 0);
  EXPECT_EQ(version->firmware_minor, 6);
  EXPECT_EQ(version->firmware_revision, 10);
  const auto heartbeat = decode_heartbeat(frame_of({0x00, 0x20, 0, 0, 8, 3, 0, 0}));
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->errors, 0x2000U);
  EXPECT_EQ(heartbeat->state, AxisState::kClosedLoop);
  EXPECT_EQ(heartbeat->procedure_result, 3);
}

TEST(Odrive, TakesOnlyWholeFrames) {
  CanFrame frame = pair_of(1.0F, 2.0F);
  ASSERT_TRUE(decode_estimates(frame));
  for (std::uint8_t size = 0; size < 8; ++size) {
    frame.size = size;
    EXPECT_FALSE(decode_estimates(frame) || decode_temperatures(frame) || decode_version(frame) ||
                 decode_heartbeat(frame))
        << int{size};
  }
}

TEST(Odrive, TakesOnlyFiniteNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(decode_estimates(pair_of(nan, 0.0F)));
  EXPECT_FALSE(decode_estimates(pair_of(0.0F, infinity)));
  EXPECT_FALSE(decode_estimates(pair_of(-infinity, 0.0F)));
  EXPECT_FALSE(decode_temperatures(pair_of(nan, nan)));
}

TEST(Odrive, TakesOneTemperatureWhenTheOtherSensorIsMissing) {
  const auto temperatures = decode_temperatures(pair_of(31.5F, std::numeric_limits<float>::quiet_NaN()));
  ASSERT_TRUE(temperatures);
  EXPECT_EQ(temperatures->inverter_C, 31.5);
  EXPECT_FALSE(temperatures->motor_C);
  EXPECT_FALSE(joint_temperature_C(TemperatureSource::kMotor, *temperatures));
}

TEST(Odrive, ReadsAParameterOnlyFromTheAnswerToIt) {
  EXPECT_EQ(read_parameter_frame(1, 0x1234).payload().size(), 4U);
  EXPECT_EQ(decode_parameter_bool(frame_of({0, 0x34, 0x12, 0, 1}), 0x1234), true);
  EXPECT_FALSE(decode_parameter_bool(frame_of({0, 0x34, 0x12, 0, 2}), 0x1234));
  EXPECT_FALSE(decode_parameter_bool(frame_of({0, 0x35, 0x12, 0, 1}), 0x1234));
  EXPECT_EQ(decode_parameter_float(frame_of({0, 0x34, 0x12, 0, 0, 0, 0, 0x3F}), 0x1234), 0.5);
  EXPECT_FALSE(decode_parameter_float(frame_of({0, 0x34, 0x12, 0, 0, 0, 0}), 0x1234));
}

TEST(Odrive, NamesEveryErrorBitAndKeepsTheUnknownOnes) {
  EXPECT_EQ(error_text(0), "no error");
  EXPECT_EQ(error_text(kUnderVoltage | kWatchdogExpired), "DC_BUS_UNDER_VOLTAGE, WATCHDOG_TIMER_EXPIRED");
  EXPECT_EQ(error_text(0x40000000), "CALIBRATION_ERROR");
  EXPECT_EQ(error_text(0x80), "0x80");
}

TEST(OdriveUnits, TurnPositionsAndTorquesBetweenDriveAndJoint) {
  UnitConfig units;
  units.encoder_turns_per_joint_turn = 50.0;
  units.gear_ratio = 50.0;
  units.direction = -1;
  units.position_offset_rad = 0.25;
  EXPECT_NEAR(joint_position_rad(units, -25.0), 0.25 + std::numbers::pi, 1e-12);
  EXPECT_NEAR(drive_torque_Nm(units, 20.0, 10.0), -0.2, 1e-12);
  units.torque_at_joint = true;
  EXPECT_NEAR(drive_torque_Nm(units, 20.0, 10.0), -10.0, 1e-12);
}

TEST(OdriveUnits, LimitTheTorqueAtTheJoint) {
  UnitConfig units;
  units.gear_ratio = 50.0;
  EXPECT_NEAR(drive_torque_Nm(units, 20.0, 1e9), 0.4, 1e-12);
  EXPECT_NEAR(drive_torque_Nm(units, 20.0, -1e9), -0.4, 1e-12);
  EXPECT_EQ(drive_torque_Nm(units, 20.0, std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace strainwave::odrive
