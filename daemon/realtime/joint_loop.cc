#include "daemon/realtime/joint_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/durations.h"
#include "daemon/realtime/state_record.h"

namespace strainwave {

namespace {

/// What an encoder cannot tell.
constexpr double kCountsOffTarget = 2.0;
/// So little of its way changes the torque of gravity by a hundredth at most.
constexpr double kSamePlace_rad = 0.01;

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
      watch_({config.controller.period_s, config.limits.overspeed_rad_s,
              config.controller.encoder_resolution_rad},
             config.missed_readings_limit),
      temperature_(config.temperature),
      schedule_(config.temperature_update_period_s, config.controller.period_s, index),
      zero_(config.homing.required),
      homing_(config.homing),
      controller_(config.controller),
      inertia_({config.controller.period_s, config.controller.encoder_resolution_rad,
                config.controller.delay_periods}),
      motion_watch_(
          {config.limits.following_error_rad, config.overload_s, config.blocked_s, config.standstill_rad_s,
           std::max(config.rest_tolerance_rad, kCountsOffTarget * config.controller.encoder_resolution_rad)}),
      held_{config.initial_load_Nm, {}} {
  record_.joint_index = index;
}

void JointLoop::step(const CycleTime& time) noexcept {
  notices_ = 0;
  controller_.begin_period(time.elapsed_periods);
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
  tell(time);
}

void JointLoop::read_drive(const CycleTime& time) noexcept {
  watch_.take(actuator_->read(time.now_ns), mode_.controlled(), motion_.joint_velocity_rad_s, time);
  if (reading().position_lost) zero_.forget();
  if (watch_.fresh() && !mode_.controlled())
    speed_gauge_.see(reading().joint_position_rad, time.now_ns);
  else
    speed_gauge_.forget();
}

void JointLoop::check_reading(const CycleTime& time) noexcept {
  if (watch_.missed()) notice(Notice::kReadingMissed);
  if (position_delay_ns() > nanoseconds(config_.controller.period_s)) notice(Notice::kPositionLate);
  if (reading().inputs.negative_limit || reading().inputs.positive_limit) notice(Notice::kAtLimitSwitch);
  // A drive that is off may be unreadable; it then cannot be enabled, which is enough.
  if (mode_.is(Mode::kOff)) return;
  if (reading().fault != ActuatorFault::kNone) return raise_fault(fault_of(reading().fault), time);
  if (watch_.too_many_missed()) raise_fault(Fault::kReadFailed, time);
}

void JointLoop::check_temperature(const CycleTime& time) noexcept {
  temperature_.update(reading().has_temperature, reading().temperature_C, reading().temperature_produced_ns,
                      time.now_ns);
  if (mode_.is(Mode::kOff)) return;
  if (temperature_.hotter_than(config_.limits.temperature_limit_C))
    return raise_fault(Fault::kTemperatureLimit, time);
  if (temperature_.lost()) raise_fault(Fault::kTemperatureLost, time);
}

void JointLoop::expire_setpoint(const CycleTime& time) noexcept {
  if (mode_.is(Mode::kTracking) && ordered_.expire(time.now_ns)) controller_.stop();
  if (ordered_.shows_expiry()) notice(Notice::kSetpointExpired);
}

void JointLoop::control(const CycleTime& time) noexcept {
  if (!mode_.controlled()) {
    motion_ = JointStep{};
    return;
  }
  // While the joint stands at its place the brake holds it, whatever the torque: nothing can be learned from that, and nothing is
  // to be done but to hold the load that is known. The first count that it moves is the control law's.
  const bool braked =
      mode_.is(Mode::kReleasing) && reading().joint_position_rad == controller_.rest_position_rad();
  if (braked) controller_.start(reading().joint_position_rad, 0.0, load_here_Nm());
  JointMeasurement measurement;
  measurement.joint_position_rad = reading().joint_position_rad;
  measurement.joint_velocity_rad_s = reading().joint_velocity_rad_s;
  measurement.temperature_C =
      schedule_.follow_C(temperature_.used_C(), time.cycle, motion_.gains_in_use != GainsInUse::kPrimary);
  measurement.has_position = watch_.fresh();
  measurement.has_velocity = reading().has_velocity;
  measurement.temperature_valid = temperature_.usable();
  measurement.late_periods = reading().position_late_periods;
  measurement.elapsed_periods =
      static_cast<int>(std::min<std::int64_t>(time.elapsed_periods, std::numeric_limits<int>::max()));
  estimate_inertia(measurement);
  motion_ = controller_.step(measurement);
  if (motion_.learns) friction_.learned_now(measurement.temperature_C, time.now_ns);
  refuse_torque_into_limit_switch();
  if (!std::isfinite(motion_.output.torque_Nm)) raise_fault(Fault::kNotFinite, time);
  note_limits(measurement);
}

void JointLoop::advance_mode(const CycleTime& time) noexcept {
  switch (mode()) {
    case Mode::kStarting:
      if (reading().drive_state == DriveState::kEnabled && watch_.fresh())
        take_over(time);
      else if (mode_.seconds(time.now_ns) > config_.start_timeout_s)
        raise_fault(Fault::kStartTimeout, time);
      return;
    case Mode::kReleasing:
      if (!reading().brake_shut)
        (void)change_mode(ModeEvent::kDriveReady, time);
      else if (mode_.seconds(time.now_ns) > config_.start_timeout_s)
        raise_fault(Fault::kStartTimeout, time);
      return;
    case Mode::kTracking:
      // A stream rests at its last setpoint until the next one comes or it expires.
      if (motion_.at_target && !ordered_.goes_on()) (void)change_mode(ModeEvent::kArrived, time);
      return;
    case Mode::kHoming:
      return end_homing(time);
    case Mode::kStopping:
      if (motion_.at_target && std::abs(motion_.joint_velocity_rad_s) < config_.standstill_rad_s)
        (void)change_mode(ModeEvent::kStopped, time);
      else if (mode_.seconds(time.now_ns) > config_.stop_timeout_s)
        raise_fault(Fault::kStopTimeout, time);
      return;
    case Mode::kOff:
    case Mode::kHolding:
    case Mode::kFaulted:
      return;
  }
}

// With the motion that there is, and with the torque that holds the load: what held it until now lets go after this period.
void JointLoop::take_over(const CycleTime& time) noexcept {
  const double measured_rad_s = measured_velocity_rad_s();
  const double velocity_rad_s = std::abs(measured_rad_s) > config_.standstill_rad_s ? measured_rad_s : 0.0;
  controller_.start(reading().joint_position_rad, velocity_rad_s, load_here_Nm());
  inertia_.forget();
  motion_watch_.begin(reading().joint_position_rad, time.now_ns);
  (void)change_mode(reading().brake_shut ? ModeEvent::kTorqueReady : ModeEvent::kDriveReady, time);
  control(time);
}

// A joint that is found elsewhere may carry something else than gravity as it is told.
double JointLoop::load_here_Nm() const noexcept {
  const double position_rad = reading().joint_position_rad;
  const double gravity_Nm = config_.controller.gravity.at(position_rad);
  if (!held_.position_rad) return held_.torque_Nm + gravity_Nm;
  return std::abs(position_rad - *held_.position_rad) < kSamePlace_rad ? held_.torque_Nm : gravity_Nm;
}

void JointLoop::command_drive(const CycleTime& time) noexcept {
  // In the fault's own cycle, and until the drive is seen to have obeyed; what follows is the order of every drive that is off.
  if (mode_.is(Mode::kFaulted) &&
      (mode_.began(time.now_ns) || reading().drive_state != DriveState::kDisabled))
    actuator_->stop();
  actuator_->write({mode_.controlled() ? motion_.output.torque_Nm : 0.0, wants_drive_enabled(mode())});
}

void JointLoop::raise_fault(Fault fault, const CycleTime& time,
                            std::optional<std::uint32_t> own_finding) noexcept {
  const Mode from = mode();
  if (!mode_.latch(fault, own_finding.value_or(reading().drive_error), time.now_ns)) return;
  // Counts may be missing from now on.
  if (fault == Fault::kReadFailed || fault == Fault::kImplausibleReading || fault == Fault::kLinkLost ||
      fault == Fault::kDriveRestarted)
    zero_.forget();
  mode_changed(from, time);
}

bool JointLoop::change_mode(ModeEvent event, const CycleTime& time) noexcept {
  const Mode from = mode();
  if (!mode_.apply(event, time.now_ns)) return false;
  if (mode() != from) mode_changed(from, time);
  return true;
}

void JointLoop::mode_changed(Mode from, const CycleTime& time) noexcept {
  (void)events_.push({index_, time.cycle, from, mode(), mode_.fault(), mode_.drive_error(), {}});
  if (mode_.is(Mode::kFaulted)) faulted_cycle_ = time.cycle;
  if (from == Mode::kHoming) homing_.abort();
  if (mode_.is(Mode::kStopping)) controller_.stop();
  // At rest: what the joint carries is known now, and something else holds it from here on.
  if (from == Mode::kStopping && mode_.is(Mode::kOff))
    held_ = {controller_.holding_torque_Nm(), reading().joint_position_rad};
  if (mode_.is(Mode::kStopping) || !mode_.controlled()) {
    ordered_.end();
    drop_path();
  }
}

void JointLoop::end(const CycleTime& time) noexcept {
  service_ = Service::kEnding;
  (void)change_mode(ModeEvent::kDisableOrdered, time);
}

void JointLoop::tell(const CycleTime& time) noexcept {
  if (!zero_.known()) notice(Notice::kNotHomed);
  if (const auto path = ordered_.path(); path && path->paused) notice(Notice::kPathPaused);
  if (ordered_.ends_path()) notice(Notice::kPathEnds);
  if (yield_) notice(Notice::kYielded);
  if (ordered_.streamed() && controller_.trajectory().ran_out_of_samples()) notice(Notice::kSamplesMissing);
  if (ordered_.contradicts()) notice(Notice::kVelocitiesContradict);
  const double friction_factor = controller_.friction_factor();
  if (differs_from_table(friction_factor)) notice(Notice::kFrictionDiffers);
  JointCycle cycle{time,  mode_,    reading(),    motion_,
                   zero_, ordered_, temperature_, controller_.temperature_weights()};
  cycle.target_rad =
      on_path() ? zero_.to_drive_rad(path_->path.last().position_rad) : controller_.trajectory().target_rad();
  cycle.joint_velocity_rad_s = measured_velocity_rad_s();
  if (mode_.controlled()) cycle.inertia_kgm2 = inertia_.inertia_kgm2();
  cycle.table_id = table_ != nullptr ? table_->id : 0;
  cycle.friction_rules_id = table_ != nullptr ? table_->friction_rules_id : 0;
  cycle.friction_rules = table_ != nullptr ? &table_->table.friction : nullptr;
  cycle.notices = notices_;
  cycle.yield = yield_;
  cycle.learned = controller_.learned();
  cycle.friction_factor = friction_factor;
  cycle.friction = friction_;
  cycle.late_samples = late_samples_;
  fill_record(cycle, record_);
  if (recorder_ != nullptr)
    recorder_->write(flight_sample(record_, time, reading().drive_state, watch_.fresh()));
}

}  // namespace strainwave
