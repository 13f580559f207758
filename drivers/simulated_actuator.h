// SPDX-License-Identifier: BSD-3-Clause
// The simulated joint as an Actuator: sim/joint/joint_plant.h with a drive that has an enable delay, an
// encoder and a slow temperature sensor. The argument of read() is the time of the joint. Between two reads
// the joint moves under the last torque, even when the loop stalls. It reads no clock, so the same times and
// orders give the same motion. Only the constructor is not real-time safe. A read after a long stall takes
// about a microsecond for each missed period.
//
// The drive never fails by itself. FaultyActuator, which wraps it, injects faults.
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
  JointPlantConfig plant;        ///< with an ideal encoder the reading contains the exact velocity as well
  TemperatureProfile ambient;    ///< over plant time, which starts at 0 with the first read()
  SimulatedInputsConfig inputs;  ///< depend on the plant's position
  bool incremental = false;      ///< the encoder counts from the position of the joint at the start
  TimeProfile load_torque_Nm;    ///< over plant time; on the link, opposes positive motor torque
  double enable_delay_s = 0.05;  ///< from the first enabling write() to kEnabled, >= 0; rounded up to periods
  double watchdog_s = 0.0;       ///< without write() for longer, torque is 0; >= 0 (0: no watchdog)
  double temperature_period_s = 0.1;  ///< the sensor produces a value this often, >= 0 (0: every period)
  double temperature_noise_C = 0.0;   ///< standard deviation of each value, >= 0
  std::uint64_t seed = 1;             ///< of the noise generator
};

/// The reference joint of the catalogue. It has the encoder, delay and supply of the datasheet, or, with
/// `exact_sensing`, only the limit of peak torque.
SimulatedActuatorConfig simulated_reference_joint(bool exact_sensing);

class SimulatedActuator final : public Actuator {
 public:
  /// Throws InputError naming the key, the value and what is allowed.
  explicit SimulatedActuator(const SimulatedActuatorConfig& config);

  ActuatorReading read(std::int64_t now_ns) noexcept override;
  /// Refuses a torque that is not finite: latches kWriteRefused and disables the drive.
  void write(const ActuatorCommand& command) noexcept override;
  void stop() noexcept override;
  void clear_fault() noexcept override { fault_ = ActuatorFault::kNone; }

  /// Replaces the configured external torque from now on; opposes positive motor torque.
  void set_load_torque_Nm(double load_torque_Nm) noexcept { set_load_Nm_ = load_torque_Nm; }

  /// The true state, for tests and plots.
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
  std::optional<double> set_load_Nm_;  ///< empty until the first set_load_torque_Nm()
  long enable_delay_periods_;
  long watchdog_periods_;
  long temperature_periods_;
  double temperature_noise_C_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;

  std::int64_t period_ns_;
  std::optional<std::int64_t> lived_until_ns_;  ///< empty before the first read()
  ActuatorCommand command_;                     ///< the last order
  DriveState drive_state_ = DriveState::kDisabled;
  ActuatorFault fault_ = ActuatorFault::kNone;
  long enabling_periods_ = 0;
  long unattended_periods_ = 0;  ///< since the last write()
  long temperature_age_periods_ = 0;
  std::int64_t temperature_produced_ns_ = 0;
  double temperature_C_ = 0.0;
};

}  // namespace strainwave
