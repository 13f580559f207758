// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulated_actuator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/input_error.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

SimulatedActuatorConfig realistic() {
  SimulatedActuatorConfig config;
  config.plant = realistic_plant();
  config.ambient = TemperatureProfile::constant(20.0);
  return config;
}

/// A loop without a controller: reads and writes once a period.
class Drive {
 public:
  explicit Drive(const SimulatedActuatorConfig& config) : actuator_(config) {
    reading_ = actuator_.read(now_ns_);
  }
  void run(int periods, double torque_Nm, bool enable = true) {
    for (int k = 0; k < periods; ++k) {
      actuator_.write({torque_Nm, enable});
      pass(1'000'000);
    }
  }
  void pass(std::int64_t duration_ns) { reading_ = actuator_.read(now_ns_ += duration_ns); }
  const ActuatorReading& reading() const { return reading_; }
  const JointState& truth() const { return actuator_.plant().state(); }
  SimulatedActuator& actuator() { return actuator_; }
  std::int64_t now_ns() const { return now_ns_; }

 private:
  SimulatedActuator actuator_;
  std::int64_t now_ns_ = 7'000'000'000;
  ActuatorReading reading_;
};

TEST(SimulatedActuator, StartsDisabledAtRestWithEverythingKnown) {
  const Drive drive(realistic());
  EXPECT_EQ(drive.reading().drive_state, DriveState::kDisabled);
  EXPECT_EQ(drive.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(drive.reading().has_position);
  EXPECT_FALSE(drive.reading().has_velocity) << "the encoder has no velocity";
  EXPECT_TRUE(drive.reading().has_temperature);
  EXPECT_EQ(drive.reading().temperature_C, 20.0);
  EXPECT_EQ(drive.reading().temperature_produced_ns, drive.now_ns());
  EXPECT_EQ(drive.reading().joint_position_rad, 0.0);
}

TEST(SimulatedActuator, EnablesAfterItsDelayAndMovesOnlyThen) {
  Drive drive(realistic());
  drive.run(50, 20.0);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kEnabling);
  EXPECT_EQ(drive.truth().position_rad, 0.0);
  drive.run(10, 20.0);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kEnabled);
  EXPECT_GT(drive.truth().position_rad, 0.0);
  EXPECT_EQ(drive.reading().torque_applied_Nm, 20.0);
}

TEST(SimulatedActuator, LivesOnUnderTheLastTorqueHoweverLongTheLoopStaysAway) {
  Drive attended(realistic());
  Drive left_alone(realistic());
  for (Drive* drive : {&attended, &left_alone}) drive->run(100, 10.0);
  attended.run(300, 10.0);
  left_alone.pass(300'000'000);
  EXPECT_EQ(left_alone.truth().position_rad, attended.truth().position_rad);
  EXPECT_GT(left_alone.truth().velocity_rad_s, 5.0) << "nobody has stopped it";
  EXPECT_EQ(left_alone.reading().temperature_produced_ns, attended.reading().temperature_produced_ns);
}

TEST(SimulatedActuator, GivesNoTorqueToALoopThatStaysAwayForLongerThanItsWatchdog) {
  SimulatedActuatorConfig config = realistic();
  config.watchdog_s = 0.005;
  Drive drive(config);
  drive.run(100, 10.0);
  drive.pass(5'000'000);
  EXPECT_EQ(drive.reading().torque_applied_Nm, 10.0);
  drive.pass(3'000'000);
  EXPECT_EQ(drive.reading().torque_applied_Nm, 0.0);
  drive.run(2, 10.0);
  EXPECT_EQ(drive.reading().torque_applied_Nm, 10.0) << "it is not latched";
}

TEST(SimulatedActuator, StandsStillInTimeWhenItIsReadTwiceAtOneInstant) {
  Drive drive(realistic());
  drive.run(100, 20.0);
  const double position_rad = drive.truth().position_rad;
  for (int i = 0; i < 10; ++i) {
    drive.actuator().write({20.0, true});
    drive.pass(0);
  }
  EXPECT_EQ(drive.truth().position_rad, position_rad);
}

TEST(SimulatedActuator, TakesAReaderThatIsNotQuiteEvenForOneThatIs) {
  Drive even(realistic());
  Drive uneven(realistic());
  for (int k = 0; k < 200; ++k) {
    for (Drive* drive : {&even, &uneven}) drive->actuator().write({10.0, true});
    even.pass(1'000'000);
    uneven.pass(k % 2 == 0 ? 1'400'000 : 600'000);
    EXPECT_EQ(uneven.truth().position_rad, even.truth().position_rad) << k;
  }
}

TEST(SimulatedActuator, CoastsToRestWhenDisabled) {
  Drive drive(realistic());
  drive.run(150, 20.0);
  const double position_rad = drive.truth().position_rad;
  drive.run(1, 20.0, false);
  EXPECT_EQ(drive.reading().torque_applied_Nm, 0.0) << "not even the torque still in the delay line";
  EXPECT_GT(drive.truth().position_rad, position_rad) << "it still moves";
  drive.run(1000, 20.0, false);
  EXPECT_TRUE(drive.truth().stuck);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kDisabled);
}

TEST(SimulatedActuator, StopsAtOnceAndNeedsItsDelayAgain) {
  Drive drive(realistic());
  drive.run(100, 20.0);
  drive.actuator().stop();
  drive.actuator().stop();
  drive.pass(0);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kDisabled);
  drive.run(1, 20.0);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kEnabling);
}

TEST(SimulatedActuator, RefusesATorqueThatIsNotFiniteUntilCleared) {
  Drive drive(realistic());
  drive.run(100, 0.0);
  drive.run(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(drive.reading().fault, ActuatorFault::kWriteRefused);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kFault);
  drive.run(100, 20.0);
  EXPECT_EQ(drive.truth().position_rad, 0.0) << "latched: no torque";
  drive.actuator().clear_fault();
  drive.pass(0);
  EXPECT_EQ(drive.reading().drive_state, DriveState::kDisabled);
  drive.run(100, 20.0);
  EXPECT_GT(drive.truth().position_rad, 0.0);
}

TEST(SimulatedActuator, SaysTheExactVelocityOnlyWithIdealSensing) {
  SimulatedActuatorConfig config = realistic();
  config.plant = ideal_plant();
  Drive drive(config);
  drive.run(100, 20.0);
  EXPECT_TRUE(drive.reading().has_velocity);
  EXPECT_EQ(drive.reading().joint_velocity_rad_s, drive.truth().velocity_rad_s);
  EXPECT_EQ(drive.reading().joint_position_rad, drive.truth().position_rad);
}

TEST(SimulatedActuator, SaysWhenTheSensorProducedItsTemperature) {
  SimulatedActuatorConfig config = realistic();
  config.ambient = TemperatureProfile::steps(0.0, 10.0, 0.05, 4);
  config.temperature_period_s = 0.02;
  Drive drive(config);
  for (int k = 0; k < 300; ++k) {
    EXPECT_EQ(drive.now_ns() - drive.reading().temperature_produced_ns, (k % 20) * 1'000'000) << k;
    EXPECT_EQ(drive.reading().temperature_C, config.ambient.at(1e-3 * (k - k % 20))) << k;
    drive.run(1, 0.0, false);
  }
}

TEST(SimulatedActuator, MakesTheSameNoiseFromTheSameSeed) {
  SimulatedActuatorConfig config = realistic();
  config.temperature_noise_C = 0.5;
  config.temperature_period_s = 0.0;
  const auto spread = [&](std::uint64_t seed) {
    config.seed = seed;
    Drive drive(config);
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < 2000; ++k) {
      drive.run(1, 0.0, false);
      const double noise_C = drive.reading().temperature_C - 20.0;
      sum += noise_C;
      squares += noise_C * noise_C;
    }
    EXPECT_NEAR(sum / 2000.0, 0.0, 0.06);
    return std::sqrt(squares / 2000.0);
  };
  EXPECT_NEAR(spread(7), 0.5, 0.05);
  EXPECT_EQ(spread(7), spread(7));
  EXPECT_NE(spread(7), spread(8));
}

TEST(SimulatedActuator, IsDrivenByTheLoad) {
  Drive drive(realistic());
  drive.actuator().set_load_torque_Nm(10.0);
  drive.run(100, 0.0, false);
  EXPECT_LT(drive.truth().position_rad, 0.0);
}

TEST(SimulatedActuator, IsDrivenByTheLoadOfItsTimeUntilAnotherIsSet) {
  SimulatedActuatorConfig config = realistic();
  config.load_torque_Nm = TimeProfile::parse("ramp:0,20,0.1,0.2", {"load_torque_Nm"});
  Drive drive(config);
  drive.run(100, 0.0, false);
  EXPECT_EQ(drive.truth().position_rad, 0.0) << "not before its time";
  drive.run(100, 0.0, false);
  const double position_rad = drive.truth().position_rad;
  EXPECT_LT(position_rad, 0.0);
  drive.actuator().set_load_torque_Nm(-20.0);
  drive.run(200, 0.0, false);
  EXPECT_GT(drive.truth().position_rad, position_rad);
}

TEST(SimulatedActuator, ReadsTheLinkWhereASecondEncoderSitsOnIt) {
  SimulatedActuatorConfig config = realistic();
  EXPECT_FALSE(Drive(config).reading().has_link_position);
  Transmission gear;
  gear.link_inertia_kgm2 = 0.1;
  gear.spring = TorsionSpring::linear(1e4);
  gear.damping_Nms_rad = 20.0;
  config.plant.effects.transmission = gear;
  config.plant.link_encoder.counts_per_joint_revolution = 1e7;
  Drive drive(config);
  drive.run(120, 10.0);
  const ActuatorReading& reading = drive.reading();
  ASSERT_TRUE(reading.has_link_position);
  EXPECT_NEAR(reading.link_position_rad, drive.actuator().plant().link_state().position_rad, 1e-6);
  EXPECT_GT(std::abs(reading.link_position_rad - reading.joint_position_rad), 1e-4)
      << "the spring is wound up";
}

TEST(SimulatedActuator, RefusesAnImpossibleConfiguration) {
  const auto spoiled = [](auto&& spoil) {
    SimulatedActuatorConfig config = realistic();
    spoil(config);
    SimulatedActuator actuator(config);
  };
  EXPECT_THROW(spoiled([](auto& c) { c.enable_delay_s = -1.0; }), InputError);
  EXPECT_THROW(spoiled([](auto& c) { c.temperature_period_s = std::nan(""); }), InputError);
  EXPECT_THROW(spoiled([](auto& c) { c.temperature_noise_C = -0.1; }), InputError);
  EXPECT_THROW(spoiled([](auto& c) { c.plant.substeps = 0; }), InputError);
}

}  // namespace
}  // namespace strainwave
