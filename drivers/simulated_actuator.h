// SPDX-License-Identifier: BSD-3-Clause
// The simulated joint behind the seam: a drive with an enable delay, an encoder and a slow temperature sensor
// around sim/joint/joint_plant.h. The joint's time is the argument of read(): the time between two
// reads passes for the joint under the last torque, however long the loop was stalled. Nothing here reads a clock, so the
// same times and orders give the same motion. The constructor is not real-time safe; the other methods are. A read after a
// long stall takes about a microsecond for each period of it.
//
// It never fails by itself. Faults are injected by a decorator: another Actuator that holds this one.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "drivers/actuator.h"
#include "drivers/simulated_inputs.h"
#include "sim/joint/joint_plant.h"
#include "sim/joint/temperature_profile.h"

namespace strainwave {

struct SimulatedActuatorConfig {
  JointPlantConfig plant;        ///< with an ideal encoder the reading has the exact velocity as well
  TemperatureProfile ambient;    ///< over plant time, which starts at 0 with the first read()
  SimulatedInputsConfig inputs;  ///< by the plant's position
  bool incremental = false;      ///< the encoder counts from where the joint stands at the start
  TimeProfile load_torque_Nm;    ///< over plant time; on the link, opposes positive motor torque
  double enable_delay_s = 0.05;  ///< from the first enabling write() to kEnabled, >= 0; counted in periods
  double watchdog_s = 0.0;  ///< without a write() for longer there is no torque, >= 0 (0: the last one stays)
  double temperature_period_s = 0.1;  ///< the sensor produces a value this often, >= 0 (0: every period)
  double temperature_noise_C = 0.0;   ///< standard deviation of each value, >= 0
  std::uint64_t seed = 1;             ///< of the noise
};

/// The catalogue's joint: with the datasheet's encoder, delay and supply, or, with `exact_sensing`, limited by its peak
/// torque only.
SimulatedActuatorConfig simulated_reference_joint(bool exact_sensing);

class SimulatedActuator final : public Actuator {
 public:
  /// Throws InputError naming the key, the value and what is allowed.
  explicit SimulatedActuator(const SimulatedActuatorConfig& config);

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  /// A torque that is not finite is refused: kWriteRefused is latched and the drive disabled.
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override;
  void clear_fault() noexcept override { fault_ = ActuatorFault::kNone; }

  /// External torque from now on, in the place of the configured one; opposes positive motor torque.
  void set_load_torque_Nm(double load_torque_Nm) noexcept { set_load_Nm_ = load_torque_Nm; }

  /// The truth, for tests and plots.
  const JointPlant& plant() const noexcept { return plant_; }

 private:
  void live_through_period() noexcept;
  void advance_drive() noexcept;
  void stop_drive() noexcept;
  void sample_temperature() noexcept;

  JointPlant plant_;
  TemperatureProfile ambient_;
  SimulatedInputs inputs_;
  double encoder_zero_rad_;
  TimeProfile load_torque_Nm_;
  std::optional<double> set_load_Nm_;  ///< once it was set
  long enable_delay_periods_;
  long watchdog_periods_;
  long temperature_periods_;
  double temperature_noise_C_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;

  std::int64_t period_ns_;
  std::optional<std::int64_t> lived_until_ns_;  ///< nothing before the first read
  ActuatorCommand command_;                     ///< the last one
  DriveState drive_state_ = DriveState::kDisabled;
  ActuatorFault fault_ = ActuatorFault::kNone;
  long enabling_periods_ = 0;
  long unattended_periods_ = 0;  ///< since the last write()
  long temperature_age_periods_ = 0;
  std::int64_t temperature_produced_ns_ = 0;
  double temperature_C_ = 0.0;
};

}  // namespace strainwave
