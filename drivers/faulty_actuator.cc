// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/faulty_actuator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/durations.h"

namespace strainwave {

FaultyActuator::FaultyActuator(std::unique_ptr<Actuator> actuator, FaultyActuatorConfig config)
    : actuator_(std::move(actuator)), config_(std::move(config)), random_(config_.seed) {
  std::stable_sort(config_.schedule.begin(), config_.schedule.end(),
                   [](const Injection& a, const Injection& b) { return a.at_s < b.at_s; });
}

void FaultyActuator::inject(const Injection& injection) noexcept {
  if (injection.kind == InjectedFault::kNone) {
    active_ = {};
    return;
  }
  of(injection.kind) = {true, false, 0, nanoseconds(injection.for_s), injection.amount};
}

void FaultyActuator::begin_and_end_faults() noexcept {
  const auto& schedule = config_.schedule;
  for (; next_scheduled_ < schedule.size(); ++next_scheduled_) {
    if (now_ns_ - first_ns_ < nanoseconds(schedule[next_scheduled_].at_s)) break;
    inject(schedule[next_scheduled_]);
  }
  for (Active& fault : active_) {
    if (fault.on && fault.begun && fault.for_ns > 0 && now_ns_ - fault.since_ns >= fault.for_ns)
      fault.on = false;
    if (fault.on && !fault.begun) fault.since_ns = now_ns_;
  }
}

ActuatorReading FaultyActuator::read(std::int64_t now_ns) noexcept {
  if (!started_) first_ns_ = now_ns;
  started_ = true;
  now_ns_ = now_ns;
  begin_and_end_faults();
  burn(InjectedFault::kSlowRead);
  ActuatorReading reading = actuator_->read(now_ns);
  falsify_position(reading);
  falsify_temperature(reading);
  if (refused_) reading.fault = ActuatorFault::kWriteRefused;
  if (of(InjectedFault::kPowerLost).on) {
    reading.fault = ActuatorFault::kPowerLost;
    reading.drive_state = DriveState::kFault;
  }
  for (Active& fault : active_) fault.begun = fault.on;
  return reading;
}

void FaultyActuator::falsify_position(ActuatorReading& reading) noexcept {
  const Active& stuck = of(InjectedFault::kSensorStuck);
  if (stuck.on && !stuck.begun) stuck_position_rad_ = reading.joint_position_rad;
  if (stuck.on) {
    reading.joint_position_rad = stuck_position_rad_;
    reading.joint_velocity_rad_s = 0.0;
  }
  const Active& delay = of(InjectedFault::kSensorDelayed);
  if (delay.on) delay_position(reading, delay);
  const Active& jump = of(InjectedFault::kSensorJump);
  if (jump.on) reading.joint_position_rad += jump.amount;
  const Active& noise = of(InjectedFault::kSensorNoisy);
  if (noise.on) reading.joint_position_rad += noise.amount * normal_(random_);
  if (of(InjectedFault::kSensorNan).on) reading.joint_position_rad = std::numeric_limits<double>::quiet_NaN();
}

// The delay line is empty when the fault begins. Until it is full, it returns its first value.
void FaultyActuator::delay_position(ActuatorReading& reading, const Active& delay) noexcept {
  if (!delay.begun) past_count_ = 0;
  constexpr std::int64_t kCapacity = kMaxSensorDelayPeriods;
  past_[static_cast<std::size_t>(past_count_ % kCapacity)] = {reading.joint_position_rad,
                                                              reading.joint_velocity_rad_s};
  const auto periods = std::min<std::int64_t>(std::llround(delay.amount / config_.period_s), kCapacity - 1);
  const Motion& shown =
      past_[static_cast<std::size_t>(std::max<std::int64_t>(0, past_count_ - periods) % kCapacity)];
  ++past_count_;
  reading.joint_position_rad = shown.position_rad;
  reading.joint_velocity_rad_s = shown.velocity_rad_s;
}

void FaultyActuator::falsify_temperature(ActuatorReading& reading) noexcept {
  const Active& stuck = of(InjectedFault::kTemperatureStuck);
  if (stuck.on && !stuck.begun) stuck_temperature_C_ = reading.temperature_C;
  if (stuck.on) reading.temperature_C = stuck_temperature_C_;
  const Active& drift = of(InjectedFault::kTemperatureDrifting);
  if (drift.on) reading.temperature_C += drift.amount * seconds(now_ns_ - drift.since_ns);
  if (of(InjectedFault::kTemperatureLost).on) reading.has_temperature = false;
}

void FaultyActuator::write(const ActuatorCommand& command) noexcept {
  refused_ = of(InjectedFault::kWriteRefused).on;
  if (of(InjectedFault::kPowerLost).on)
    last_command_ = {};
  else if (!refused_)
    last_command_ = command;
  actuator_->write(last_command_);
  burn(InjectedFault::kOverrun);
}

void FaultyActuator::stop() noexcept {
  last_command_ = {};
  actuator_->stop();
}

void FaultyActuator::burn(InjectedFault kind) noexcept {
  if (of(kind).on && config_.busy_wait != nullptr) config_.busy_wait(nanoseconds(of(kind).amount));
}

}  // namespace strainwave
