// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_drive.h"

#include <cmath>
#include <limits>

#include "lcmtypes/reading_doubt.h"
#include "tests/daemon/realtime/joint/scripted_joint.h"

namespace strainwave::testing {
namespace {

class JointDriveTest : public ::testing::Test {
 protected:
  static JointLoopConfig config() {
    JointLoopConfig config;
    config.limits.overspeed_rad_s = 5.0;
    config.controller.encoder_resolution_rad = 2e-5;
    config.missed_readings_limit = 3;
    return config;
  }
  JointDriveTest() {
    reading_.has_position = true;
    reading_.drive_state = DriveState::kEnabled;
  }
  const ActuatorReading& take(bool controlled = true, double velocity_rad_s = 0.0) {
    time_.now_ns += 1'000'000;
    ++time_.cycle;
    actuator_->reading = reading_;
    drive_.read(controlled, velocity_rad_s, time_);
    return drive_.reading();
  }
  ScriptedActuator* actuator_ = new ScriptedActuator;
  JointDrive drive_{config(), std::unique_ptr<Actuator>(actuator_)};
  ActuatorReading reading_;
  CycleTime time_;
};

TEST_F(JointDriveTest, PassesAGoodReadingOnAsItIs) {
  reading_.joint_position_rad = 0.5;
  reading_.joint_velocity_rad_s = 0.25;
  reading_.has_velocity = true;
  EXPECT_EQ(take().joint_position_rad, 0.5);
  EXPECT_EQ(drive_.reading().joint_velocity_rad_s, 0.25);
  EXPECT_TRUE(drive_.fresh());
  EXPECT_FALSE(drive_.missed());
}

TEST_F(JointDriveTest, CarriesAMissingPositionOnByTheVelocityOfAControlledJointOnly) {
  reading_.joint_position_rad = 0.5;
  take();
  reading_.has_position = false;
  EXPECT_DOUBLE_EQ(take(true, 2.0).joint_position_rad, 0.502);
  EXPECT_DOUBLE_EQ(take(true, 2.0).joint_position_rad, 0.504);
  EXPECT_DOUBLE_EQ(take(false, 2.0).joint_position_rad, 0.504);
  EXPECT_FALSE(drive_.fresh());
  EXPECT_EQ(drive_.reading().fault, ActuatorFault::kNone);
}

TEST_F(JointDriveTest, MeasuresTheSpeedOfACoastingJointThroughItsCounts) {
  constexpr double kCount_rad = 2e-5;
  const auto coast = [&](double velocity_rad_s, int periods) {
    const double from_rad = reading_.joint_position_rad;
    for (int i = 1; i <= periods; ++i) {
      reading_.joint_position_rad =
          kCount_rad * std::round((from_rad + velocity_rad_s * 1e-3 * i) / kCount_rad);
      take(false);
    }
  };
  reading_.joint_position_rad = 3.0;
  take(false);
  EXPECT_EQ(drive_.velocity_rad_s(), 0.0) << "one position is no motion";
  for (const double velocity_rad_s : {0.02, -0.5, 3.6, 0.0}) {
    coast(velocity_rad_s, 500);
    EXPECT_NEAR(drive_.velocity_rad_s(), velocity_rad_s, kCount_rad / 0.02);
  }
  reading_.has_position = false;
  take(false);
  EXPECT_EQ(drive_.velocity_rad_s(), 0.0);
  reading_.has_position = true;
  reading_.joint_position_rad = 1.0;
  take(false);
  EXPECT_EQ(drive_.velocity_rad_s(), 0.0) << "it may have been moved by hand";
}

TEST_F(JointDriveTest, CountsMissesInARowAndForgivesThemWhenTold) {
  EXPECT_TRUE(drive_.too_many_missed()) << "nothing has been heard";
  take();
  EXPECT_FALSE(drive_.missed());
  reading_.has_position = false;
  for (int i = 0; i < 3; ++i) take();
  EXPECT_TRUE(drive_.missed());
  EXPECT_FALSE(drive_.too_many_missed());
  take();
  EXPECT_TRUE(drive_.too_many_missed());
  drive_.clear_fault();
  EXPECT_FALSE(drive_.missed());
  for (int i = 0; i < 3; ++i) take();
  EXPECT_FALSE(drive_.too_many_missed());
  reading_.has_position = true;
  take();
  EXPECT_FALSE(drive_.missed());
}

TEST_F(JointDriveTest, CallsNoNumberOrAJumpImplausibleSaysWhichAndGoesOnWithNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  take();
  reading_.has_velocity = true;
  const std::pair<double ActuatorReading::*, ReadingDoubt> fields[]{
      {&ActuatorReading::joint_position_rad, ReadingDoubt::kPositionNotFinite},
      {&ActuatorReading::torque_applied_Nm, ReadingDoubt::kTorqueNotFinite},
      {&ActuatorReading::joint_velocity_rad_s, ReadingDoubt::kVelocityNotFinite}};
  for (const auto& [field, doubt] : fields) {
    reading_.*field = nan;
    const ActuatorReading& taken = take();
    EXPECT_EQ(taken.fault, ActuatorFault::kImplausible);
    EXPECT_EQ(taken.drive_error, doubt_number(doubt));
    EXPECT_EQ(taken.joint_position_rad, 0.0);
    EXPECT_EQ(taken.torque_applied_Nm, 0.0);
    reading_.*field = 0.0;
  }
  EXPECT_EQ(take().drive_error, 0U);
  reading_.joint_position_rad = 0.5;
  EXPECT_EQ(take().drive_error, doubt_number(ReadingDoubt::kJump, 0.5));
  EXPECT_EQ(drive_.reading().fault, ActuatorFault::kImplausible);
  reading_.has_position = false;
  reading_.fault = ActuatorFault::kImplausible;
  EXPECT_EQ(take().drive_error, doubt_number(ReadingDoubt::kCountsMissing)) << "the drive's own finding";
  reading_.fault = ActuatorFault::kDriveFault;
  reading_.drive_error = 0x2310;
  EXPECT_EQ(take().drive_error, 0x2310U) << "no doubt takes the place of the drive's own number";
}

TEST_F(JointDriveTest, SaysHowFarAStuckSensorMustHaveMoved) {
  drive_.set_joint(0.1, 1.0);
  take();
  for (int i = 0; i < 100 && drive_.reading().fault == ActuatorFault::kNone; ++i) {
    if (i == 10) reading_.torque_applied_Nm = 20.0;
    take();
  }
  EXPECT_EQ(drive_.reading().fault, ActuatorFault::kImplausible);
  EXPECT_EQ(drive_.reading().drive_error >> 24U, static_cast<std::uint32_t>(ReadingDoubt::kStuck));
  EXPECT_GE(drive_.reading().drive_error & 0xFFFFFFU, 200U) << "ten counts";
}

TEST_F(JointDriveTest, IgnoresAVelocityThatTheDriveDoesNotGive) {
  reading_.joint_velocity_rad_s = std::numeric_limits<double>::quiet_NaN();
  take();
  EXPECT_TRUE(drive_.fresh());
}

TEST_F(JointDriveTest, LeavesTheDrivesOwnFaultInItsPlace) {
  take();
  reading_.joint_position_rad = 0.5;
  reading_.fault = ActuatorFault::kPowerLost;
  EXPECT_EQ(take().fault, ActuatorFault::kPowerLost);
}

}  // namespace
}  // namespace strainwave::testing
