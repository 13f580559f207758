// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint_drive.h"

#include <utility>

namespace strainwave {

JointDrive::JointDrive(const JointLoopConfig& config, std::unique_ptr<Actuator> actuator)
    : actuator_(std::move(actuator)),
      injector_(dynamic_cast<FaultyActuator*>(actuator_.get())),
      watch_({config.controller.period_s, config.limits.overspeed_rad_s,
              config.controller.encoder_resolution_rad},
             config.missed_readings_limit),
      temperature_(config.temperature) {}

void JointDrive::read(bool controlled, double velocity_rad_s, const CycleTime& time) noexcept {
  watch_.take(actuator_->read(time.now_ns), controlled, velocity_rad_s, time);
  if (fresh() && !controlled)
    speed_gauge_.see(position_rad(), time.now_ns);
  else
    speed_gauge_.forget();
  temperature_.update(reading().has_temperature, reading().temperature_C, reading().temperature_produced_ns,
                      time.now_ns);
}

void JointDrive::clear_fault() noexcept {
  actuator_->clear_fault();
  watch_.forgive();
}

bool JointDrive::inject(const Injection& injection) noexcept {
  if (injector_ == nullptr) return false;
  injector_->inject(injection);
  return true;
}

bool JointDrive::into_limit_switch(double direction) const noexcept {
  return direction < 0.0 ? reading().inputs.negative_limit
                         : direction > 0.0 && reading().inputs.positive_limit;
}

}  // namespace strainwave
