// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/torque_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {
namespace {

/// data/rhs17_datasheet.csv, joint side: 9.6 Nm/A, 4.8 ohm, 1 V/rpm, 75 V; amplifier 5 A.
TorqueOutputConfig current() {
  TorqueOutputConfig config;
  config.full_scale_Nm = 9.6 * 5.0;
  return config;
}
TorqueOutputConfig voltage() {
  TorqueOutputConfig config;
  config.amplifier = AmplifierKind::kVoltage;
  config.motor = MotorLimits::from_motor({34.0, 9.6, 9.549, 4.8, 75.0});
  return config;
}
/// Returns the output after the wait before a change of direction.
TorqueOutput::Output settled(TorqueOutput& output, double torque_Nm, double velocity_rad_s = 0.0) {
  for (int i = 0; i < 10; ++i) (void)output.step(torque_Nm, velocity_rad_s);
  return output.step(torque_Nm, velocity_rad_s);
}

TEST(TorqueOutput, IsACurrentByTheTorqueConstant) {
  TorqueOutput output(current());
  EXPECT_NEAR(settled(output, 24.0).duty, 0.5, 1e-12) << "24 Nm are 2.5 A of 5 A";
  EXPECT_FALSE(settled(output, 24.0).negative);
  EXPECT_NEAR(settled(output, -24.0).duty, 0.5, 1e-12);
  EXPECT_TRUE(settled(output, -24.0).negative);
  EXPECT_NEAR(settled(output, -24.0).torque_applied_Nm, -24.0, 1e-12);
}

TEST(TorqueOutput, TellsWhatTheAmplifierGivesWhereItIsAskedForMore) {
  TorqueOutput output(current());
  const TorqueOutput::Output most = settled(output, 100.0);
  EXPECT_EQ(most.duty, 1.0);
  EXPECT_NEAR(most.torque_applied_Nm, 48.0, 1e-12);
}

TEST(TorqueOutput, KeepsToTheDutyLimits) {
  for (const BridgeKind bridge : {BridgeKind::kSignMagnitude, BridgeKind::kLockedAntiphase}) {
    TorqueOutputConfig config = current();
    config.bridge = bridge;
    config.duty_min = 0.1;
    config.duty_max = 0.9;
    TorqueOutput output(config);
    for (double torque_Nm = -60.0; torque_Nm <= 60.0; torque_Nm += 0.5) {
      const double duty = output.step(torque_Nm, 0.0).duty;
      EXPECT_GE(duty, 0.1);
      EXPECT_LE(duty, 0.9);
    }
    EXPECT_NEAR(settled(output, 48.0).duty, 0.9, 1e-12);
    const bool antiphase = bridge == BridgeKind::kLockedAntiphase;
    EXPECT_NEAR(settled(output, -48.0).duty, antiphase ? 0.1 : 0.9, 1e-12);
    EXPECT_NEAR(output.idle().duty, antiphase ? 0.5 : 0.1, 1e-12);
  }
}

TEST(TorqueOutput, AsAVoltageMakesUpForBackEmfAndResistance) {
  TorqueOutput output(voltage());
  EXPECT_NEAR(settled(output, 9.6).duty, 4.8 / 75.0, 1e-12) << "1 A through 4.8 ohm";
  EXPECT_NEAR(settled(output, 9.6, 2.0).duty, (4.8 + 2.0 * 9.549) / 75.0, 1e-12);
  const TorqueOutput::Output at_speed = settled(output, 34.0, 8.0);
  EXPECT_EQ(at_speed.duty, 1.0) << "the supply is not enough";
  EXPECT_NEAR(at_speed.torque_applied_Nm, 9.6 * (75.0 - 9.549 * 8.0) / 4.8, 1e-9);
  EXPECT_TRUE(settled(output, 0.0, -2.0).negative) << "no torque at speed needs the back-EMF's voltage";
}

TEST(TorqueOutput, ChangesDirectionOnlyAfterTheDeadTimeWithoutTorque) {
  TorqueOutputConfig config = current();
  config.dead_time_s = 0.003;
  TorqueOutput output(config);
  ASSERT_FALSE(settled(output, 10.0).negative);
  for (int i = 0; i < 3; ++i) {
    const TorqueOutput::Output dead = output.step(-10.0, 0.0);
    EXPECT_EQ(dead.duty, 0.0) << i;
    EXPECT_FALSE(dead.negative) << i;
    EXPECT_EQ(dead.torque_applied_Nm, 0.0);
  }
  EXPECT_TRUE(output.step(-10.0, 0.0).negative);
  config.dead_time_s = 0.0;
  TorqueOutput at_once(config);
  (void)settled(at_once, 10.0);
  EXPECT_EQ(at_once.step(-10.0, 0.0).duty, 0.0) << "one period in any case";
  EXPECT_GT(at_once.step(-10.0, 0.0).duty, 0.0);
}

TEST(TorqueOutput, NeverRisesFasterThanItsSlewButStopsAtOnce) {
  TorqueOutputConfig config = current();
  config.slew_Nm_s = 1000.0;
  TorqueOutput output(config);
  double last_Nm = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double torque_Nm = output.step(20.0, 0.0).torque_applied_Nm;
    EXPECT_LE(torque_Nm - last_Nm, 1.0 + 1e-9);
    last_Nm = torque_Nm;
  }
  EXPECT_NEAR(last_Nm, 20.0, 1e-9);
  EXPECT_EQ(output.idle().torque_applied_Nm, 0.0);
  EXPECT_LE(output.step(20.0, 0.0).torque_applied_Nm, 1.0 + 1e-9) << "and begins from there";
}

TEST(TorqueOutput, MirrorsAReversedMotor) {
  TorqueOutputConfig config = current();
  config.reversed = true;
  TorqueOutput output(config);
  EXPECT_TRUE(settled(output, 10.0).negative);
  EXPECT_NEAR(settled(output, 10.0).torque_applied_Nm, 10.0, 1e-12);
}

TEST(TorqueOutput, GivesNoTorqueForANumberThatIsNone) {
  TorqueOutput output(current());
  (void)settled(output, 10.0);
  EXPECT_EQ(output.step(std::numeric_limits<double>::quiet_NaN(), 0.0).duty, 0.0);
}

}  // namespace
}  // namespace strainwave
