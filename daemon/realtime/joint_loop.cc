#include "daemon/realtime/joint_loop.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

/// A speed this close to its limit is at it.
constexpr double kAtLimit = 1.0 - 1e-9;

Fault fault_of(ActuatorFault fault) noexcept {
  switch (fault) {
    case ActuatorFault::kNone:
      return Fault::kNone;
    case ActuatorFault::kReadFailed:
      return Fault::kReadFailed;
    case ActuatorFault::kWriteRefused:
      return Fault::kWriteRefused;
    case ActuatorFault::kDriveFault:
      return Fault::kDriveFault;
    case ActuatorFault::kPowerLost:
      return Fault::kPowerLost;
    case ActuatorFault::kImplausible:
      return Fault::kImplausibleReading;
    case ActuatorFault::kLinkLost:
      return Fault::kLinkLost;
    case ActuatorFault::kEmergencyStop:
      return Fault::kEmergencyStop;
    case ActuatorFault::kDriveRestarted:
      return Fault::kDriveRestarted;
    case ActuatorFault::kBusError:
      return Fault::kBusError;
  }
  return Fault::kDriveFault;
}

}  // namespace

JointLoop::JointLoop(std::int64_t index, const JointLoopConfig& config, std::unique_ptr<Actuator> actuator,
                     ReplyQueue& replies, EventQueue& events)
    : index_(index),
      config_(config),
      actuator_(std::move(actuator)),
      injector_(dynamic_cast<FaultyActuator*>(actuator_.get())),
      replies_(replies),
      events_(events),
      controller_(config.controller),
      homing_(config.homing),
      temperature_(config.temperature),
      position_check_({config.controller.period_s, config.limits.overspeed_rad_s,
                       config.controller.encoder_resolution_rad}),
      temperature_update_periods_(std::max<std::int64_t>(
          1, std::llround(config.temperature_update_period_s / config.controller.period_s))) {
  record_.joint_index = index;
}

void JointLoop::step(const CycleTime& time) noexcept {
  notices_ = 0;
  take_orders(time);
  read_drive(time);
  check_reading(time);
  check_temperature(time);
  expire_setpoint(time);
  advance_homing(time);
  control(time);
  check_motion(time);
  advance_mode(time);
  command_drive(time);
  fill_record(time);
  record_flight(time);
}

void JointLoop::read_drive(const CycleTime& time) noexcept {
  const ActuatorReading reading = actuator_->read(time.now_ns);
  reading_fresh_ = reading.has_position && std::isfinite(reading.joint_position_rad) &&
                   (!reading.has_velocity || std::isfinite(reading.joint_velocity_rad_s)) &&
                   std::isfinite(reading.torque_applied_Nm);
  const double last_position_rad = reading_.joint_position_rad;
  const bool malformed = reading.has_position && !reading_fresh_;
  reading_ = reading;
  if (!reading_fresh_) {
    // Where the joint must be by now: a position that stands still and then jumps would look like a blocked joint.
    const double moved_rad =
        is_controlled(mode_) ? motion_.joint_velocity_rad_s * config_.controller.period_s : 0.0;
    reading_.joint_position_rad = last_position_rad + moved_rad;
    reading_.has_velocity = false;
    reading_.torque_applied_Nm = 0.0;
  }
  ever_read_ = ever_read_ || reading_fresh_;
  const bool driven = reading.drive_state == DriveState::kEnabled && is_controlled(mode_);
  const bool impossible =
      reading_fresh_ &&
      !position_check_.plausible(reading.joint_position_rad, reading.torque_applied_Nm, driven, time.now_ns);
  if ((malformed || impossible) && reading_.fault == ActuatorFault::kNone)
    reading_.fault = ActuatorFault::kImplausible;
}

void JointLoop::check_reading(const CycleTime& time) noexcept {
  missed_readings_ = reading_fresh_ ? 0 : std::min(missed_readings_ + 1, config_.missed_readings_limit + 1);
  if (missed_readings_ > 0) notice(Notice::kReadingMissed);
  if (reading_.inputs.negative_limit || reading_.inputs.positive_limit) notice(Notice::kAtLimitSwitch);
  // A drive that is off may be unreadable; it then cannot be enabled, which is enough.
  if (mode_ == Mode::kOff) return;
  if (reading_.fault != ActuatorFault::kNone) return raise_fault(fault_of(reading_.fault), time);
  if (missed_readings_ > config_.missed_readings_limit) raise_fault(Fault::kReadFailed, time);
}

void JointLoop::check_temperature(const CycleTime& time) noexcept {
  temperature_.update(reading_.has_temperature, reading_.temperature_C,
                      time.now_ns - reading_.temperature_age_ns, time.now_ns);
  const bool hot =
      temperature_.status() == TemperatureStatus::kValid && temperature_.used_C() > config_.limits.hot_C;
  if (hot && mode_ != Mode::kOff) raise_fault(Fault::kTemperatureLimit, time);
}

void JointLoop::expire_setpoint(const CycleTime& time) noexcept {
  if (mode_ == Mode::kTracking && setpoint_expires_ns_ != 0 && time.now_ns >= setpoint_expires_ns_) {
    controller_.stop();
    setpoint_expires_ns_ = 0;
    setpoint_expired_ = true;
    stream_refused_ = true;
  }
  if (setpoint_expired_) notice(Notice::kSetpointExpired);
}

// Layer 1 of the friction model at its own slower period; joints take turns, so that no cycle pays for all of them.
double JointLoop::scheduling_temperature_C(const CycleTime& time) noexcept {
  const bool first = motion_.gains_in_use != GainsInUse::kPrimary;
  if (first || time.cycle >= next_temperature_cycle_) {
    scheduling_temperature_C_ = temperature_.used_C();
    next_temperature_cycle_ =
        time.cycle + temperature_update_periods_ - (time.cycle + index_) % temperature_update_periods_;
  }
  return scheduling_temperature_C_;
}

void JointLoop::control(const CycleTime& time) noexcept {
  if (!is_controlled(mode_)) {
    motion_ = JointStep{};
    return;
  }
  JointMeasurement measurement;
  measurement.joint_position_rad = reading_.joint_position_rad;
  measurement.joint_velocity_rad_s = reading_.joint_velocity_rad_s;
  measurement.temperature_C = scheduling_temperature_C(time);
  measurement.has_velocity = reading_.has_velocity;
  measurement.temperature_valid = temperature_.usable();
  motion_ = controller_.step(measurement);
  refuse_torque_into_limit_switch();
  if (!std::isfinite(motion_.output.torque_Nm)) raise_fault(Fault::kNotFinite, time);
  if (motion_.output.saturated) notice(Notice::kTorqueLimited);
  if (motion_.gains_in_use == GainsInUse::kFallback)
    notice(Notice::kFallbackGains);
  else if (measurement.temperature_C < table_min_C_ || measurement.temperature_C > table_max_C_)
    notice(Notice::kTemperatureClamped);
  const double speed_limit_rad_s = config_.controller.motion.velocity_rad_s;
  if (std::abs(motion_.reference.velocity_rad_s) >= kAtLimit * speed_limit_rad_s)
    notice(Notice::kSpeedLimited);
}

void JointLoop::check_motion(const CycleTime& time) noexcept {
  if (!is_controlled(mode_)) return;
  const JointLimits& limits = config_.limits;
  const double position_rad = reading_.joint_position_rad;
  const double known_rad = position_rad + position_offset_rad_;
  if (position_known() && (known_rad < limits.position_min_rad - limits.position_margin_rad ||
                           known_rad > limits.position_max_rad + limits.position_margin_rad))
    return raise_fault(Fault::kPositionLimit, time);
  if (mode_ != Mode::kHoming && into_limit_switch(motion_.reference.velocity_rad_s))
    return raise_fault(Fault::kLimitSwitch, time);
  if (std::abs(motion_.joint_velocity_rad_s) > limits.overspeed_rad_s)
    return raise_fault(Fault::kSpeedLimit, time);
  if (std::abs(motion_.reference.position_rad - position_rad) > limits.following_error_rad)
    raise_fault(Fault::kFollowingError, time);
}

void JointLoop::advance_mode(const CycleTime& time) noexcept {
  switch (mode_) {
    case Mode::kStarting:
      if (reading_.drive_state == DriveState::kEnabled && reading_fresh_) {
        controller_.start(reading_.joint_position_rad);
        (void)change_mode(ModeEvent::kDriveReady, time);
      } else if (seconds_in_mode(time) > config_.start_timeout_s) {
        raise_fault(Fault::kStartTimeout, time);
      }
      return;
    case Mode::kTracking:
      // A stream rests at its last setpoint until the next one comes or it expires.
      if (motion_.at_target && setpoint_expires_ns_ == 0) (void)change_mode(ModeEvent::kArrived, time);
      return;
    case Mode::kHoming:
      return end_homing(time);
    case Mode::kStopping:
      if (motion_.at_target && std::abs(motion_.joint_velocity_rad_s) < config_.standstill_rad_s)
        (void)change_mode(ModeEvent::kStopped, time);
      else if (seconds_in_mode(time) > config_.stop_timeout_s)
        raise_fault(Fault::kStopTimeout, time);
      return;
    case Mode::kOff:
    case Mode::kHolding:
    case Mode::kFaulted:
      return;
  }
}

void JointLoop::command_drive(const CycleTime& /*time*/) noexcept {
  if (mode_ == Mode::kFaulted) {
    // Until the drive is seen to have obeyed; what follows is the order of every drive that is off.
    if (!drive_stopped_ || reading_.drive_state != DriveState::kDisabled) actuator_->stop();
    drive_stopped_ = true;
  }
  actuator_->write({is_controlled(mode_) ? motion_.output.torque_Nm : 0.0, wants_drive_enabled(mode_)});
}

void JointLoop::raise_fault(Fault fault, const CycleTime& time) noexcept {
  if (mode_ == Mode::kFaulted) return;  // the first fault is the one that is shown
  ++faults_total_;
  drive_error_ = reading_.drive_error;
  drive_stopped_ = false;
  // Counts may be missing from now on.
  if (fault == Fault::kReadFailed || fault == Fault::kImplausibleReading || fault == Fault::kLinkLost)
    homed_ = false;
  group_stop_due_ = config_.fault_stops_group && fault != Fault::kGroup;
  (void)change_mode(ModeEvent::kFaultRaised, time, fault);
}

bool JointLoop::change_mode(ModeEvent event, const CycleTime& time, Fault fault) noexcept {
  const auto next = next_mode(mode_, event);
  if (!next) return false;
  if (*next != mode_) {
    (void)events_.push({index_, time.cycle, mode_, *next, fault, drive_error_});
    if (mode_ == Mode::kHoming) homing_.abort();
    mode_ = *next;
    mode_since_ns_ = time.now_ns;
    if (mode_ == Mode::kStopping) controller_.stop();
  }
  fault_ = mode_ == Mode::kFaulted ? (fault == Fault::kNone ? fault_ : fault) : Fault::kNone;
  return true;
}

void JointLoop::fill_record(const CycleTime& time) noexcept {
  state_v1& state = record_.state;
  const bool controlled = is_controlled(mode_);
  if (!position_known()) notice(Notice::kNotHomed);
  state.cycle = time.cycle;
  state.table_id = table_id_;
  const double position_rad = reading_.joint_position_rad + position_offset_rad_;
  state.setpoint_position_rad =
      controlled ? motion_.reference.position_rad + position_offset_rad_ : position_rad;
  state.setpoint_velocity_rad_s = controlled ? motion_.reference.velocity_rad_s : 0.0;
  // To the bit what was ordered, so that whoever ordered it knows it again.
  const bool as_ordered = controller_.target_rad() == ordered_target_rad_;
  const double target_rad =
      as_ordered ? ordered_position_rad_ : controller_.target_rad() + position_offset_rad_;
  state.target_position_rad = controlled ? target_rad : position_rad;
  state.joint_position_rad = position_rad;
  state.joint_velocity_rad_s = controlled ? motion_.joint_velocity_rad_s : reading_.joint_velocity_rad_s;
  state.torque_commanded_Nm = controlled ? motion_.output.torque_Nm : 0.0;
  state.torque_applied_Nm = reading_.torque_applied_Nm;
  state.torque_feedback_Nm = motion_.output.feedback_torque_Nm;
  state.torque_feedforward_Nm = motion_.output.feedforward_torque_Nm;
  state.temperature_C = temperature_.used_C();
  state.zero_velocity_weight = motion_.output.zero_velocity_weight;
  const TemperatureWeights& weights = controller_.temperature_weights();
  std::copy(weights.weight.begin(), weights.weight.end(), state.temperature_weights);
  state.rule_count = temperature_rules_;
  state.mode = static_cast<std::int32_t>(mode_);
  state.fault = static_cast<std::int32_t>(fault_);
  state.notices = notices_;
  state.gains_in_use = static_cast<std::int32_t>(motion_.gains_in_use);
  state.temperature_status = static_cast<std::int32_t>(temperature_.status());
  state.faults_total = faults_total_;
  // The drive may forget; what it said when the fault came is what explains it.
  state.drive_error = mode_ == Mode::kFaulted ? drive_error_ : reading_.drive_error;
  record_.temperature_measured_C = temperature_.measured_C();
  record_.temperature_age_s = temperature_.age_s(time.now_ns);
}

void JointLoop::record_flight(const CycleTime& time) noexcept {
  if (recorder_ == nullptr) return;
  const state_v1& state = record_.state;
  FlightSample sample;
  sample.time_ns = time.now_ns;
  sample.cycle = time.cycle;
  sample.table_id = state.table_id;
  sample.setpoint_position_rad = state.setpoint_position_rad;
  sample.setpoint_velocity_rad_s = state.setpoint_velocity_rad_s;
  sample.target_position_rad = state.target_position_rad;
  sample.joint_position_rad = state.joint_position_rad;
  sample.joint_velocity_rad_s = state.joint_velocity_rad_s;
  sample.torque_commanded_Nm = state.torque_commanded_Nm;
  sample.torque_applied_Nm = state.torque_applied_Nm;
  sample.torque_feedback_Nm = state.torque_feedback_Nm;
  sample.torque_feedforward_Nm = state.torque_feedforward_Nm;
  sample.temperature_C = state.temperature_C;
  sample.temperature_measured_C = record_.temperature_measured_C;
  sample.zero_velocity_weight = state.zero_velocity_weight;
  sample.notices = static_cast<std::uint16_t>(notices_);
  sample.mode = static_cast<std::uint8_t>(state.mode);
  sample.fault = static_cast<std::uint8_t>(state.fault);
  sample.gains_in_use = static_cast<std::uint8_t>(state.gains_in_use);
  sample.temperature_status = static_cast<std::uint8_t>(state.temperature_status);
  sample.drive_state = static_cast<std::uint8_t>(reading_.drive_state);
  sample.reading_fresh = reading_fresh_ ? 1 : 0;
  recorder_->write(sample);
}

}  // namespace strainwave
