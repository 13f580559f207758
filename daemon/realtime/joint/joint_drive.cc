// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/durations.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

namespace {

/// Averaging time of the speed without control: a count of 20 urad then shows as a tenth of the usual standstill_rad_s.
constexpr double kMean_s = 0.02;

ReadingDoubt not_finite(const ActuatorReading& reading) noexcept {
  if (!std::isfinite(reading.joint_position_rad)) return ReadingDoubt::kPositionNotFinite;
  if (reading.has_velocity && !std::isfinite(reading.joint_velocity_rad_s))
    return ReadingDoubt::kVelocityNotFinite;
  return std::isfinite(reading.torque_applied_Nm) ? ReadingDoubt::kNone : ReadingDoubt::kTorqueNotFinite;
}

}  // namespace

JointDrive::JointDrive(const JointLoopConfig& config, std::unique_ptr<Actuator> actuator)
    : actuator_(std::move(actuator)),
      injector_(dynamic_cast<FaultyActuator*>(actuator_.get())),
      position_check_(config),
      temperature_(config.temperature),
      period_s_(config.controller.period_s),
      slowest_rad_s_(config.controller.encoder_resolution_rad / kMean_s),
      missed_limit_(config.missed_readings_limit),
      missed_(missed_limit_ + 1) {}

void JointDrive::read(bool controlled, double velocity_rad_s, const CycleTime& time) noexcept {
  const ActuatorReading reading = actuator_->read(time.now_ns);
  fresh_ = reading.has_position && not_finite(reading) == ReadingDoubt::kNone;
  const double last_position_rad = std::exchange(reading_, reading).joint_position_rad;
  const double elapsed_s = static_cast<double>(time.elapsed_periods) * period_s_;
  if (!fresh_) go_on_without(last_position_rad, controlled ? velocity_rad_s * elapsed_s : 0.0);
  if (controlled || !fresh_)
    velocity_rad_s_ = 0.0;
  else if (missed_ == 0)
    velocity_rad_s_ +=
        (position_rad() - last_position_rad - velocity_rad_s_ * elapsed_s) / (kMean_s + elapsed_s);
  const std::int64_t missed = missed_ + time.elapsed_periods;
  missed_ = fresh_ ? 0 : static_cast<int>(std::min<std::int64_t>(missed, missed_limit_ + 1));
  // A shut brake holds the joint, whatever the torque.
  doubt(reading, reading.drive_state == DriveState::kEnabled && controlled && !reading.brake_shut, time);
  temperature_.update(reading.has_temperature, reading.temperature_C, reading.temperature_produced_ns,
                      time.now_ns);
}

// Extrapolates: a position that stands still and then jumps would look like a blocked joint.
void JointDrive::go_on_without(double last_position_rad, double moved_rad) noexcept {
  reading_.joint_position_rad = last_position_rad + moved_rad;
  reading_.has_velocity = false;
  reading_.torque_applied_Nm = 0.0;
  reading_.torque_measured = false;
}

void JointDrive::doubt(const ActuatorReading& reading, bool driven, const CycleTime& time) noexcept {
  // The check needs the time between samples, not arrivals: after a stall the newest position is from before it.
  const std::int64_t sampled_ns = time.now_ns - nanoseconds(reading.position_late_periods * period_s_);
  const bool possible = !fresh_ || position_check_.plausible(reading.joint_position_rad,
                                                             reading.torque_applied_Nm, driven, sampled_ns);
  const bool malformed = reading.has_position && !fresh_;
  if (reading.fault == ActuatorFault::kImplausible)
    reading_.drive_error = doubt_number(ReadingDoubt::kCountsMissing);
  if (reading.fault != ActuatorFault::kNone || (possible && !malformed)) return;
  reading_.fault = ActuatorFault::kImplausible;
  reading_.drive_error = malformed ? doubt_number(not_finite(reading)) : position_check_.doubt();
}

void JointDrive::clear_fault() noexcept {
  actuator_->clear_fault();
  missed_ = 0;
}

bool JointDrive::inject(const Injection& injection) noexcept {
  if (injector_ == nullptr) return false;
  injector_->inject(injection);
  return true;
}

}  // namespace strainwave
