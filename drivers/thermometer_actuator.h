// SPDX-License-Identifier: BSD-3-Clause
// A drive with a separate temperature sensor: it holds another Actuator and replaces the temperature of the
// drive by that of a file. Everything but the constructor is real-time safe.
#pragma once

#include <memory>
#include <utility>

#include "drivers/actuator.h"
#include "drivers/temperature_file.h"

namespace strainwave {

class ThermometerActuator final : public Actuator {
 public:
  /// Throws InputError when the file cannot be read.
  ThermometerActuator(std::unique_ptr<Actuator> actuator, const TemperatureFileConfig& thermometer)
      : actuator_(std::move(actuator)), thermometer_(thermometer) {}

  ActuatorReading read(std::int64_t now_ns) noexcept override {
    ActuatorReading reading = actuator_->read(now_ns);
    const TemperatureFile::Sample& sample = thermometer_.newest();
    reading.has_temperature = sample.valid;
    reading.temperature_C = sample.temperature_C;
    reading.temperature_produced_ns = sample.produced_ns;
    return reading;
  }
  void write(const ActuatorCommand& command) noexcept override { actuator_->write(command); }
  void stop() noexcept override { actuator_->stop(); }
  void clear_fault() noexcept override { actuator_->clear_fault(); }

 private:
  std::unique_ptr<Actuator> actuator_;
  TemperatureFile thermometer_;
};

}  // namespace strainwave
