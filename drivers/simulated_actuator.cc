// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulated_actuator.h"

#include <cmath>
#include <string>

#include "base/durations.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {

namespace {

double checked_not_negative(double value, const char* key) {
  if (!(std::isfinite(value) && value >= 0.0))
    throw InputError("simulated actuator", key, number_text(value), "must be finite and >= 0");
  return value;
}

long whole_periods(double duration_s, double period_s) {
  return std::lround(std::ceil(duration_s / period_s - 1e-9));
}

}  // namespace

SimulatedActuatorConfig simulated_reference_joint(bool exact_sensing) {
  SimulatedActuatorConfig config;
  config.plant = exact_sensing ? torque_limited_plant() : realistic_plant();
  return config;
}

SimulatedActuator::SimulatedActuator(const SimulatedActuatorConfig& config)
    : plant_(config.plant),
      ambient_(config.ambient),
      inputs_(config.inputs),
      encoder_zero_rad_(config.incremental ? plant_.measured_position_rad() : 0.0),
      load_torque_Nm_(config.load_torque_Nm),
      enable_delay_periods_(whole_periods(checked_not_negative(config.enable_delay_s, "enable_delay_s"),
                                          config.plant.period_s)),
      watchdog_periods_(
          whole_periods(checked_not_negative(config.watchdog_s, "watchdog_s"), config.plant.period_s)),
      temperature_periods_(whole_periods(
          checked_not_negative(config.temperature_period_s, "temperature_period_s"), config.plant.period_s)),
      temperature_noise_C_(checked_not_negative(config.temperature_noise_C, "temperature_noise_C")),
      random_(config.seed),
      period_ns_(nanoseconds(config.plant.period_s)) {
  plant_.set_ambient_temperature(ambient_.at(0.0));
  sample_temperature();
}

ActuatorReading SimulatedActuator::read(std::int64_t now_ns) noexcept {
  if (!lived_until_ns_) temperature_produced_ns_ = *(lived_until_ns_ = now_ns);
  // Rounds to the nearest whole period because the caller's period has jitter.
  while (now_ns - *lived_until_ns_ > period_ns_ / 2) {
    *lived_until_ns_ += period_ns_;
    live_through_period();
  }
  ActuatorReading reading;
  reading.joint_position_rad = plant_.measured_position_rad() - encoder_zero_rad_;
  reading.inputs =
      inputs_.at(plant_.link_state().position_rad, plant_.link_state().position_rad - encoder_zero_rad_);
  reading.has_position = true;
  reading.has_velocity = plant_.config().encoder.counts_per_joint_revolution <= 0.0;
  if (reading.has_velocity) reading.joint_velocity_rad_s = plant_.feedback_state().velocity_rad_s;
  reading.has_link_position = plant_.has_link_encoder();
  reading.link_position_rad = plant_.measured_link_position_rad() - encoder_zero_rad_;
  reading.torque_applied_Nm = plant_.applied_torque_Nm();
  reading.torque_measured = true;
  reading.temperature_C = temperature_C_;
  reading.temperature_produced_ns = temperature_produced_ns_;
  reading.has_temperature = true;
  reading.drive_state = fault_ == ActuatorFault::kNone ? drive_state_ : DriveState::kFault;
  reading.fault = fault_;
  return reading;
}

void SimulatedActuator::write(const ActuatorCommand& command) noexcept {
  if (command.enable && !std::isfinite(command.torque_Nm)) fault_ = ActuatorFault::kWriteRefused;
  command_ = command;
  unattended_periods_ = 0;
  if (!command_.enable) stop_drive();
}

void SimulatedActuator::stop() noexcept {
  command_ = {};
  stop_drive();
}

void SimulatedActuator::stop_drive() noexcept {
  drive_state_ = DriveState::kDisabled;
  enabling_periods_ = 0;
  plant_.clear_pending_torque();
}

void SimulatedActuator::live_through_period() noexcept {
  advance_drive();
  const bool powered = drive_state_ == DriveState::kEnabled;
  if (!powered) plant_.clear_pending_torque();
  const bool attended = watchdog_periods_ == 0 || ++unattended_periods_ <= watchdog_periods_;
  plant_.step(powered && attended ? command_.torque_Nm : 0.0,
              set_load_Nm_.value_or(load_torque_Nm_.at(plant_.time_s())));
  plant_.set_ambient_temperature(ambient_.at(plant_.time_s()));
  if (++temperature_age_periods_ >= temperature_periods_) sample_temperature();
}

void SimulatedActuator::advance_drive() noexcept {
  if (!command_.enable || fault_ != ActuatorFault::kNone) {
    stop_drive();
  } else if (drive_state_ != DriveState::kEnabled) {
    drive_state_ = enabling_periods_ >= enable_delay_periods_ ? DriveState::kEnabled : DriveState::kEnabling;
    ++enabling_periods_;
  }
}

void SimulatedActuator::sample_temperature() noexcept {
  temperature_C_ = plant_.sensor_temperature_C();
  if (temperature_noise_C_ > 0.0) temperature_C_ += temperature_noise_C_ * normal_(random_);
  temperature_age_periods_ = 0;
  temperature_produced_ns_ = lived_until_ns_.value_or(0);
}

}  // namespace strainwave
