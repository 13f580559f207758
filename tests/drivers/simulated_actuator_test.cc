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

void write_for(SimulatedActuator& actuator, int periods, double torque_Nm, bool enable = true) {
  for (int k = 0; k < periods; ++k) actuator.write({torque_Nm, enable});
}

TEST(SimulatedActuator, StartsDisabledAtRestWithEverythingKnown) {
  SimulatedActuator actuator(realistic());
  const ActuatorReading reading = actuator.read(0);
  EXPECT_EQ(reading.drive_state, DriveState::kDisabled);
  EXPECT_EQ(reading.fault, ActuatorFault::kNone);
  EXPECT_TRUE(reading.has_position);
  EXPECT_FALSE(reading.has_velocity) << "the encoder has no velocity";
  EXPECT_TRUE(reading.has_temperature);
  EXPECT_EQ(reading.temperature_C, 20.0);
  EXPECT_EQ(reading.joint_position_rad, 0.0);
}

TEST(SimulatedActuator, EnablesAfterItsDelayAndMovesOnlyThen) {
  SimulatedActuator actuator(realistic());
  write_for(actuator, 50, 20.0);
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kEnabling);
  EXPECT_EQ(actuator.plant().state().position_rad, 0.0);
  write_for(actuator, 10, 20.0);
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kEnabled);
  EXPECT_GT(actuator.plant().state().position_rad, 0.0);
  EXPECT_EQ(actuator.read(0).torque_applied_Nm, 20.0);
}

TEST(SimulatedActuator, CoastsToRestWhenDisabled) {
  SimulatedActuator actuator(realistic());
  write_for(actuator, 150, 20.0);
  const double position_rad = actuator.plant().state().position_rad;
  actuator.write({20.0, false});
  EXPECT_EQ(actuator.read(0).torque_applied_Nm, 0.0) << "not even the torque still in the delay line";
  EXPECT_GT(actuator.plant().state().position_rad, position_rad) << "it still moves";
  write_for(actuator, 1000, 20.0, false);
  EXPECT_TRUE(actuator.plant().state().stuck);
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kDisabled);
}

TEST(SimulatedActuator, StopsAtOnceAndNeedsItsDelayAgain) {
  SimulatedActuator actuator(realistic());
  write_for(actuator, 100, 20.0);
  actuator.stop();
  actuator.stop();
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kDisabled);
  actuator.write({20.0, true});
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kEnabling);
}

TEST(SimulatedActuator, RefusesATorqueThatIsNotFiniteUntilCleared) {
  SimulatedActuator actuator(realistic());
  write_for(actuator, 100, 0.0);
  actuator.write({std::numeric_limits<double>::quiet_NaN(), true});
  EXPECT_EQ(actuator.read(0).fault, ActuatorFault::kWriteRefused);
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kFault);
  write_for(actuator, 100, 20.0);
  EXPECT_EQ(actuator.plant().state().position_rad, 0.0) << "latched: no torque";
  actuator.clear_fault();
  EXPECT_EQ(actuator.read(0).drive_state, DriveState::kDisabled);
  write_for(actuator, 100, 20.0);
  EXPECT_GT(actuator.plant().state().position_rad, 0.0);
}

TEST(SimulatedActuator, SaysTheExactVelocityOnlyWithIdealSensing) {
  SimulatedActuatorConfig config = realistic();
  config.plant = ideal_plant();
  SimulatedActuator actuator(config);
  write_for(actuator, 100, 20.0);
  const ActuatorReading reading = actuator.read(0);
  EXPECT_TRUE(reading.has_velocity);
  EXPECT_EQ(reading.joint_velocity_rad_s, actuator.plant().state().velocity_rad_s);
  EXPECT_EQ(reading.joint_position_rad, actuator.plant().state().position_rad);
}

TEST(SimulatedActuator, AgesTheTemperatureBetweenTheSensorsSamples) {
  SimulatedActuatorConfig config = realistic();
  config.ambient = TemperatureProfile::steps(0.0, 10.0, 0.05, 4);
  config.temperature_period_s = 0.02;
  SimulatedActuator actuator(config);
  for (int k = 0; k < 300; ++k) {
    const ActuatorReading reading = actuator.read(0);
    EXPECT_EQ(reading.temperature_age_ns, (k % 20) * 1'000'000) << k;
    EXPECT_EQ(reading.temperature_C, config.ambient.at(1e-3 * (k - k % 20))) << k;
    actuator.write({0.0, false});
  }
}

TEST(SimulatedActuator, MakesTheSameNoiseFromTheSameSeed) {
  SimulatedActuatorConfig config = realistic();
  config.temperature_noise_C = 0.5;
  config.temperature_period_s = 0.0;
  const auto spread = [&](std::uint64_t seed) {
    config.seed = seed;
    SimulatedActuator actuator(config);
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < 2000; ++k) {
      actuator.write({0.0, false});
      const double noise_C = actuator.read(0).temperature_C - 20.0;
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
  SimulatedActuator actuator(realistic());
  actuator.set_load_torque_Nm(10.0);
  write_for(actuator, 100, 0.0, false);
  EXPECT_LT(actuator.plant().state().position_rad, 0.0);
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
  EXPECT_THROW(spoiled([](auto& c) { c.load_torque_Nm = std::nan(""); }), InputError);
  EXPECT_THROW(spoiled([](auto& c) { c.plant.substeps = 0; }), InputError);
}

}  // namespace
}  // namespace strainwave
