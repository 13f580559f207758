// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/thermometer_actuator.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr std::int64_t kNow_ns = 5'000'000'000;
std::int64_t standing_clock() noexcept {
  return kNow_ns;
}

/// A drive that measures its own power stage.
class HotDrive final : public Actuator {
 public:
  ActuatorReading read(std::int64_t /*now_ns*/) noexcept override {
    ActuatorReading reading;
    reading.joint_position_rad = 0.5;
    reading.has_position = reading.has_temperature = true;
    reading.temperature_C = 90.0;
    return reading;
  }
  void write(const ActuatorCommand& /*command*/) noexcept override {}
  void stop() noexcept override {}
  void clear_fault() noexcept override {}
};

TEST(ThermometerActuator, ShowsTheThermometersTemperatureWithItsInstantAndEverythingElseOfTheDrive) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "temp1_input") << "-12500\n";
  TemperatureFileConfig thermometer;
  thermometer.file = folder.path() / "temp1_input";
  thermometer.clock_ns = &standing_clock;
  ThermometerActuator actuator(std::make_unique<HotDrive>(), thermometer);
  ActuatorReading reading = actuator.read(kNow_ns + 2'000'000'000);
  for (int i = 0; i < 20000 && !reading.has_temperature; ++i) {
    EXPECT_NE(reading.temperature_C, 90.0) << "never the drive's own";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    reading = actuator.read(kNow_ns + 2'000'000'000);
  }
  ASSERT_TRUE(reading.has_temperature);
  EXPECT_EQ(reading.temperature_C, -12.5);
  EXPECT_EQ(reading.temperature_produced_ns, kNow_ns);
  EXPECT_EQ(reading.joint_position_rad, 0.5);
}

}  // namespace
}  // namespace strainwave
