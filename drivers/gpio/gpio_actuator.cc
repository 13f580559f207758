// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/gpio_actuator.h"

#include <algorithm>
#include <array>
#include <utility>

namespace strainwave {

GpioActuator::GpioActuator(GpioParts parts, const GpioMotionConfig& motion, const TorqueOutputConfig& torque,
                           const DriveSequenceConfig& sequence, const Debounce& debounce)
    : parts_(std::move(parts)),
      motion_(motion),
      torque_(torque),
      sequence_(sequence),
      debounce_(debounce),
      last_output_(torque_.idle()) {}

GpioActuator::~GpioActuator() {
  stop();
}

ActuatorReading GpioActuator::read(std::int64_t now_ns) noexcept {
  now_ns_ = now_ns;
  ActuatorReading reading;
  lines_failed_ = !parts_.lines->read(active_);
  if (!lines_failed_) active_ = debounce_.step(active_, now_ns);
  read_position(reading);
  read_inputs(reading);
  reading.torque_applied_Nm = last_output_.torque_applied_Nm;
  // If several faults are present, the one that matters most to the operator is reported.
  if (const ActuatorFault fault = fault_of_inputs(); fault != ActuatorFault::kNone) reading.fault = fault;
  reading.drive_state = sequence_.drive_state();
  reading.brake_shut = sequence_.has_torque() && !sequence_.may_move();
  return reading;
}

void GpioActuator::read_position(ActuatorReading& reading) noexcept {
  const CountSource::Sample sample = parts_.counts->read(now_ns_);
  const double counts = static_cast<double>(motion_.encoder_reversed ? -sample.counts : sample.counts);
  const double position_rad = counts * motion_.count_rad;
  reading.joint_position_rad = position_rad;
  reading.has_position = sample.state == CountSource::State::kFresh;
  if (sample.state == CountSource::State::kImplausible) reading.fault = ActuatorFault::kImplausible;
  // This velocity serves the back-EMF compensation only; the loop has its own observer.
  if (reading.has_position && has_position_) {
    const double difference_rad_s = (position_rad - position_rad_) / motion_.period_s;
    const double share = motion_.period_s / (motion_.period_s + motion_.velocity_filter_s);
    velocity_rad_s_ += share * (difference_rad_s - velocity_rad_s_);
  }
  position_rad_ = position_rad;
  has_position_ = reading.has_position;
}

void GpioActuator::read_inputs(ActuatorReading& reading) noexcept {
  const auto active = [&](LineRole role) { return (active_ & bit(role)) != 0; };
  reading.inputs.negative_limit = active(LineRole::kNegativeLimit);
  reading.inputs.positive_limit = active(LineRole::kPositiveLimit);
  reading.inputs.home = active(LineRole::kHome);
  if (!parts_.index) return;
  std::array<Edge, EdgeEvents::kReadAtOnce> edges;
  const int count = parts_.index->read(edges);
  lines_failed_ = lines_failed_ || count < 0;
  for (int i = 0; i < count; ++i) index_.pulse(edges[static_cast<std::size_t>(i)].time_ns);
  if (reading.has_position) index_.sample(reading.joint_position_rad, now_ns_);
  index_.fill(reading.inputs);
}

ActuatorFault GpioActuator::fault_of_inputs() const noexcept {
  if (lines_failed_) return ActuatorFault::kConnectionLost;
  if ((active_ & bit(LineRole::kEmergencyStop)) != 0) return ActuatorFault::kEmergencyStop;
  // A disabled amplifier may signal "not ready", which is no fault.
  if (sequence_.amplifier_ready() && (active_ & bit(LineRole::kAmplifierFault)) != 0)
    return ActuatorFault::kDriveFault;
  return write_failed_ ? ActuatorFault::kWriteRefused : ActuatorFault::kNone;
}

void GpioActuator::write(const ActuatorCommand& command) noexcept {
  alive_ = !alive_;
  // With a failed line the state of the outputs is unknown, so the drive stops.
  if (lines_failed_ || write_failed_) return put_out(torque_.idle(), sequence_.stop(now_ns_));
  const DriveSequence::Outputs outputs = sequence_.step(command.enable, now_ns_);
  if (sequence_.has_torque())
    put_out(torque_.step(command.torque_Nm, velocity_rad_s_), outputs);
  else
    put_out(sequence_.holds_torque() ? last_output_ : torque_.idle(), outputs);
}

void GpioActuator::stop() noexcept {
  put_out(torque_.idle(), sequence_.stop(now_ns_));
}

void GpioActuator::clear_fault() noexcept {
  write_failed_ = false;
  parts_.counts->clear_fault();
}

// Zero torque is set before the lines change, other torque after them and only if they are right. If a call fails, the PWM goes idle.
void GpioActuator::put_out(const TorqueOutput::Output& torque,
                           const DriveSequence::Outputs& sequence) noexcept {
  const std::uint32_t lines = (sequence.enable ? bit(LineRole::kEnable) : 0) |
                              (sequence.brake_open ? bit(LineRole::kBrakeRelease) : 0) |
                              (torque.negative ? bit(LineRole::kDirection) : 0) |
                              (alive_ ? bit(LineRole::kAlive) : 0);
  const bool idle = torque.duty == torque_.idle_duty();
  bool good = true;
  if (idle) good = parts_.pwm->set_duty(torque.duty) && good;
  good = parts_.lines->write(lines) && good;
  if (!idle) good = good && parts_.pwm->set_duty(torque.duty);
  if (!good && !idle) (void)parts_.pwm->set_idle();
  write_failed_ = write_failed_ || !good;
  last_output_ = good ? torque : torque_.idle();
}

}  // namespace strainwave
