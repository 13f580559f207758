// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_loop.h"

#include <cmath>
#include <utility>

#include "base/durations.h"
#include "daemon/realtime/loop/state_record.h"

namespace strainwave {

namespace {

// The fault for each ActuatorFault, in their order.
constexpr std::array kFaults{Fault::kNone,           Fault::kReadFailed,    Fault::kWriteRefused,
                             Fault::kDriveFault,     Fault::kPowerLost,     Fault::kImplausibleReading,
                             Fault::kConnectionLost, Fault::kEmergencyStop, Fault::kDriveRestarted,
                             Fault::kBusError};
static_assert(kFaults.size() == static_cast<std::size_t>(ActuatorFault::kBusError) + 1);

// Uses the last plausible temperature.
double driving_share(const JointInLoop& joint) noexcept {
  const TemperatureCheck& temperature = joint.drive.temperature();
  return temperature.known() ? joint.config.limits.driving_share(temperature.used_C()) : 1.0;
}

}  // namespace

JointLoop::JointLoop(std::int64_t index, const JointLoopConfig& config, std::unique_ptr<Actuator> actuator,
                     ReplyQueue& replies, EventQueue& events)
    : joint_(index, config, std::move(actuator), events), replies_(replies) {
  record_.joint_index = index;
}

void JointLoop::step(const CycleTime& time) noexcept {
  joint_.notices = 0;
  // A move keeps the share with which it began, despite the sensor's noise. Paths and streams, which other joints may share, get full torque.
  if (joint_.ordered.goes_on())
    driving_share_ = 1.0;
  else if (record_.state.setpoint_velocity_rad_s == 0.0)
    driving_share_ = driving_share(joint_);
  joint_.law.controller().begin_period(time.elapsed_periods, driving_share_);
  take_orders(time);
  read_drive(time);
  check_reading(time);
  check_temperature(time);
  expire_setpoint(time);
  advance_homing(joint_, time);
  control(time);
  check_motion(joint_, time);
  advance_mode(time);
  command_drive(time);
  publish(time);
}

void JointLoop::take_orders(const CycleTime& time) noexcept {
  Order order;
  while (orders_.pop(order)) {
    // The loop may have stood still while the order waited, or the joint may have faulted.
    const bool waited_long = order.expires_cycle >= 0 && time.cycle > order.expires_cycle;
    const bool from_before_fault =
        order.challenge_cycle >= 0 && order.challenge_cycle <= joint_.faulted_cycle;
    const bool too_old = waited_long || from_before_fault;
    const Ruling ruling = too_old ? Ruling(Reason::kTooOld) : obey(joint_, order, time, tables_);
    if (order.kind == OrderKind::kLoadPath) joint_.path_slots.judged();
    // A full reply queue loses the answer, not the order; the client sees a time-out and asks the state.
    if (order.id != 0) (void)replies_.push({order.id, ruling.reason, mode(), ruling.value, ruling.limit});
  }
}

void JointLoop::read_drive(const CycleTime& time) noexcept {
  joint_.drive.read(joint_.mode.controlled(), joint_.law.motion().joint_velocity_rad_s, time);
  if (joint_.drive.reading().position_lost) joint_.zero.forget();
}

void JointLoop::check_reading(const CycleTime& time) noexcept {
  const ActuatorReading& reading = joint_.drive.reading();
  if (joint_.drive.missed()) joint_.notice(Notice::kReadingMissed);
  if (joint_.drive.position_delay_ns() > nanoseconds(joint_.config.controller.period_s))
    joint_.notice(Notice::kPositionLate);
  if (reading.inputs.negative_limit || reading.inputs.positive_limit) joint_.notice(Notice::kAtLimitSwitch);
  // A drive that is off may be unreadable; it then cannot be enabled, which is enough.
  if (joint_.mode.is(Mode::kOff)) return;
  if (reading.fault != ActuatorFault::kNone)
    return joint_.raise_fault(kFaults[static_cast<std::size_t>(reading.fault)], time);
  if (joint_.drive.too_many_missed()) joint_.raise_fault(Fault::kReadFailed, time);
}

void JointLoop::check_temperature(const CycleTime& time) noexcept {
  const TemperatureCheck& temperature = joint_.drive.temperature();
  if (driving_share_ < 1.0) joint_.notice(Notice::kDerated);
  if (joint_.mode.is(Mode::kOff)) return;
  if (temperature.hotter_than(joint_.config.limits.temperature_limit_C))
    return joint_.raise_fault(Fault::kTemperatureLimit, time);
  if (temperature.lost()) joint_.raise_fault(Fault::kTemperatureLost, time);
}

void JointLoop::expire_setpoint(const CycleTime& time) noexcept {
  if (joint_.mode.is(Mode::kTracking) && joint_.ordered.expire(time.now_ns)) joint_.law.controller().stop();
  if (joint_.ordered.shows_expiry()) joint_.notice(Notice::kSetpointExpired);
}

void JointLoop::control(const CycleTime& time) noexcept {
  if (!joint_.mode.controlled()) return joint_.law.rest();
  const bool brake_opens = joint_.mode.is(Mode::kReleasing);
  if (brake_opens) joint_.law.wait_for_brake(joint_.drive.position_rad());
  joint_.law.run(joint_.drive, time, brake_opens);
  const double torque_Nm = joint_.law.motion().output.torque_Nm;
  // Homing moves into switches on purpose, slowly, and needs its torque to reach a stop.
  if (!joint_.config.controller.drive_closes_loop() && !joint_.mode.is(Mode::kHoming) &&
      joint_.drive.reading().inputs.limit_towards(torque_Nm))
    joint_.law.refuse_torque();
  if (!std::isfinite(torque_Nm)) joint_.raise_fault(Fault::kNotFinite, time);
  note_limits(joint_);
}

void JointLoop::advance_mode(const CycleTime& time) noexcept {
  const JointStep& motion = joint_.law.motion();
  const double seconds = joint_.mode.seconds(time.now_ns);
  switch (mode()) {
    case Mode::kStarting:
      if (joint_.drive.reading().drive_state == DriveState::kEnabled && joint_.drive.fresh())
        take_over(time);
      else if (seconds > joint_.config.start_timeout_s)
        joint_.raise_fault(Fault::kStartTimeout, time);
      return;
    case Mode::kReleasing:
      if (!joint_.drive.reading().brake_shut)
        (void)joint_.change_mode(ModeEvent::kDriveReady, time);
      else if (seconds > joint_.config.start_timeout_s)
        joint_.raise_fault(Fault::kStartTimeout, time);
      return;
    case Mode::kTracking:
      // A stream rests at its last setpoint until the next one comes or it expires.
      if (motion.at_target && !joint_.ordered.goes_on()) (void)joint_.change_mode(ModeEvent::kArrived, time);
      return;
    case Mode::kHoming:
      return end_homing(joint_, time);
    case Mode::kStopping:
      if (motion.at_target && std::abs(motion.joint_velocity_rad_s) < joint_.config.standstill_rad_s)
        (void)joint_.change_mode(ModeEvent::kStopped, time);
      else if (seconds > joint_.config.stop_timeout_s)
        joint_.raise_fault(Fault::kStopTimeout, time);
      return;
    case Mode::kOff:
    case Mode::kHolding:
    case Mode::kFaulted:
      return;
  }
}

// Starts the control law from the present motion.
void JointLoop::take_over(const CycleTime& time) noexcept {
  const double measured_rad_s = joint_.velocity_rad_s();
  const double velocity_rad_s =
      std::abs(measured_rad_s) > joint_.config.standstill_rad_s ? measured_rad_s : 0.0;
  const double position_rad = joint_.drive.position_rad();
  joint_.law.take_over(position_rad, velocity_rad_s);
  joint_.motion_watch.begin(position_rad, time.now_ns);
  const bool brake_shut = joint_.drive.reading().brake_shut;
  (void)joint_.change_mode(brake_shut ? ModeEvent::kTorqueReady : ModeEvent::kDriveReady, time);
  control(time);
}

void JointLoop::command_drive(const CycleTime& time) noexcept {
  // Stops the drive in the fault's own cycle and until it reports kDisabled. Then the usual command to a disabled drive suffices.
  if (joint_.mode.is(Mode::kFaulted) &&
      (joint_.mode.began(time.now_ns) || joint_.drive.reading().drive_state != DriveState::kDisabled))
    joint_.drive.stop();
  ActuatorCommand command;
  command.enable = wants_drive_enabled(mode());
  command.motor_position_rad = joint_.drive.position_rad();
  if (joint_.mode.controlled()) {
    const JointStep& motion = joint_.law.motion();
    command.torque_Nm = motion.output.torque_Nm;
    command.motor_position_rad = motion.order.position_rad;
    command.motor_velocity_rad_s = motion.order.velocity_rad_s;
  }
  joint_.drive.write(command);
}

void JointLoop::end(const CycleTime& time) noexcept {
  joint_.ending = true;
  (void)joint_.change_mode(ModeEvent::kDisableOrdered, time);
}

// Notices of conditions that last longer than a period.
void JointLoop::note_standing() noexcept {
  const OrderedTarget& ordered = joint_.ordered;
  const JointController& controller = joint_.law.controller();
  if (!joint_.zero.known()) joint_.notice(Notice::kNotHomed);
  if (const auto path = ordered.path(); path && path->paused) joint_.notice(Notice::kPathPaused);
  if (joint_.yield) joint_.notice(Notice::kYielded);
  if (ordered.streamed() && controller.plan().trajectory().ran_out_of_samples())
    joint_.notice(Notice::kSamplesMissing);
  if (ordered.contradicts()) joint_.notice(Notice::kVelocitiesContradict);
  if (differs_from_table(controller.friction().factor())) joint_.notice(Notice::kFrictionDiffers);
}

void JointLoop::publish(const CycleTime& time) noexcept {
  note_standing();
  fill_record(joint_, time, record_);
  if (recorder_ != nullptr)
    recorder_->write(flight_sample(record_, time, joint_.drive.reading().drive_state, joint_.drive.fresh()));
}

void stop_groups_of_the_faulted(std::span<const std::unique_ptr<JointLoop>> joints,
                                const CycleTime& time) noexcept {
  for (const auto& faulted : joints) {
    if (!faulted->joint().stops_group(time)) continue;
    for (const auto& other : joints) {
      if (other->joint().config.group != faulted->joint().config.group || other->joint().at_rest()) continue;
      other->joint().raise_fault(Fault::kGroup, time);
      other->joint().drive.stop();
    }
  }
}

void fault_driven_joints(std::span<const std::unique_ptr<JointLoop>> joints, Fault fault,
                         const CycleTime& time) noexcept {
  for (const auto& joint : joints)
    if (joint->mode() != Mode::kOff) joint->joint().raise_fault(fault, time);
}

}  // namespace strainwave
