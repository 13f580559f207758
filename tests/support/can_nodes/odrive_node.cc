// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/odrive_node.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "tests/support/can_nodes/text.h"

namespace strainwave::can_nodes {

namespace {

constexpr std::uint32_t kTorqueControl = 1;
constexpr std::uint32_t kVelocityControl = 2;
constexpr std::uint32_t kPositionControl = 3;
constexpr std::uint32_t kPassthrough = 1;
constexpr std::uint8_t kProcedureSuccess = 0;
constexpr std::uint8_t kProcedureDisarmed = 3;
constexpr double kVelocityShare = 0.3;

// Takes a value from a frame into `input`. Ignores a value that is not finite.
bool take(double& input, double value) {
  if (std::isfinite(value)) input = value;
  return std::isfinite(value);
}

double int16_at(const Frame& frame, std::size_t offset) {
  return static_cast<std::int16_t>(little_endian(frame.bytes().subspan(offset, 2)));
}

JointPlantConfig plant_of(const OdriveNodeConfig& config) {
  JointPlantConfig plant = config.plant;
  plant.encoder.counts_per_joint_revolution = config.counts_per_joint_revolution;
  return plant;
}

}  // namespace

OdriveNode::OdriveNode(const OdriveNodeConfig& config, NodeOutput& output)
    : config_(config),
      output_(output),
      plant_(plant_of(config)),
      step_us_(std::llround(config.plant.period_s * 1e6)),
      bus_V_(config.bus_V) {
  plant_.set_ambient_temperature(config_.ambient.at(0.0));
}

void OdriveNode::power_on(std::int64_t now_us) {
  now_us_ = now_us;
  next_step_us_ = now_us + step_us_;
  boot();
}

void OdriveNode::boot() {
  booting_ = true;
  boot_done_us_ = now_us_ + config_.boot_us;
  set_state(OdriveState::kIdle);
  errors_ = disarm_reason_ = 0;
  procedure_result_ = kProcedureSuccess;
  control_mode_ = 3;
  input_mode_ = 1;
  input_position_turns_ = input_velocity_turns_s_ = input_torque_Nm_ = 0.0;
  watchdog_deadline_us_.reset();
  output_.note("boot");
}

void OdriveNode::set_state(OdriveState state) {
  arming_done_us_.reset();
  if (state == state_) return;
  state_ = state;
  const JointState& joint = plant_.state();
  output_.note(format("state %s position_rad=%.6f velocity_rad_s=%.6f",
                      state == OdriveState::kIdle ? "idle" : "closed-loop", joint.position_rad,
                      joint.velocity_rad_s));
  awaiting_rest_ = state == OdriveState::kIdle;
}

void OdriveNode::disarm(std::uint32_t error) {
  errors_ |= error;
  output_.note(format("error %08X", error));
  if (state_ == OdriveState::kClosedLoop) {
    disarm_reason_ = error;
    procedure_result_ = kProcedureDisarmed;
    set_state(OdriveState::kIdle);
  }
}

void OdriveNode::feed_watchdog() {
  watchdog_deadline_us_ = now_us_ + std::llround(config_.watchdog_timeout_s * 1e6);
}

void OdriveNode::request_state(std::uint32_t state) {
  if (state == static_cast<std::uint32_t>(OdriveState::kIdle)) {
    procedure_result_ = kProcedureSuccess;
    set_state(OdriveState::kIdle);
  } else if (state == static_cast<std::uint32_t>(OdriveState::kClosedLoop)) {
    if (state_ == OdriveState::kClosedLoop || refuses_to_arm_) return;
    if (errors_ != 0)
      procedure_result_ = kProcedureDisarmed;
    else if (!arming_done_us_)
      arming_done_us_ = now_us_ + config_.arming_us;
  }
}

void OdriveNode::receive(const Frame& frame, std::int64_t now_us) {
  advance(now_us);
  if (cable_cut_ || booting_ || frame.id >> 5 != config_.node_id) return;
  const auto command = static_cast<OdriveCommand>(frame.id & 0x1F);
  if (frame.remote)
    send(command);
  else
    obey(command, frame);
}

void OdriveNode::obey(OdriveCommand command, const Frame& frame) {
  const auto has = [&](std::uint8_t length) { return frame.length >= length; };
  switch (command) {
    case OdriveCommand::kEstop:
      disarm(kOdriveEstopRequested);
      break;
    case OdriveCommand::kReadOrWrite:
      if (has(4)) answer_endpoint(frame);
      break;
    case OdriveCommand::kSetAxisState:
      if (has(4)) request_state(static_cast<std::uint32_t>(little_endian(frame.bytes().first(4))));
      break;
    case OdriveCommand::kSetControllerMode:
      if (!has(8)) break;
      control_mode_ = static_cast<std::uint32_t>(little_endian(frame.bytes().first(4)));
      input_mode_ = static_cast<std::uint32_t>(little_endian(frame.bytes().subspan(4, 4)));
      output_.note(format("mode control=%u input=%u", control_mode_, input_mode_));
      break;
    case OdriveCommand::kSetInputTorque:
      if (!has(4)) break;
      take(input_torque_Nm_, static_cast<double>(float_at(frame, 0)));
      ++inputs_;
      feed_watchdog();
      break;
    case OdriveCommand::kSetInputPosition:
      if (!has(8)) break;
      take(input_position_turns_, static_cast<double>(float_at(frame, 0)));
      input_velocity_turns_s_ = int16_at(frame, 4) / config_.velocity_units_per_turn_s;
      input_torque_Nm_ = int16_at(frame, 6) / config_.torque_units_per_Nm;
      ++inputs_;
      feed_watchdog();
      break;
    case OdriveCommand::kSetInputVelocity:
      if (!has(8)) break;
      take(input_velocity_turns_s_, static_cast<double>(float_at(frame, 0)));
      take(input_torque_Nm_, static_cast<double>(float_at(frame, 4)));
      ++inputs_;
      feed_watchdog();
      break;
    case OdriveCommand::kReboot:
      boot();
      break;
    case OdriveCommand::kClearErrors:
      errors_ = 0;
      output_.note("errors cleared");
      break;
    default:
      break;
  }
}

// Sends the cyclic messages that are due.
void OdriveNode::send_cyclic() {
  const auto cyclic = [&](OdriveCommand command, std::int64_t period_us) {
    auto& next_us = next_cyclic_us_[command];
    if (period_us <= 0 || now_us_ < next_us) return;
    send(command);
    next_us = std::max(next_us + period_us, now_us_ + period_us / 2);
  };
  cyclic(OdriveCommand::kHeartbeat, heartbeat_off_ ? 0 : config_.heartbeat_us);
  cyclic(OdriveCommand::kEncoderEstimates, config_.encoder_us);
  cyclic(OdriveCommand::kTemperature, config_.temperature_us);
  cyclic(OdriveCommand::kBusVoltageCurrent, config_.bus_us);
  cyclic(OdriveCommand::kGetError, config_.error_us);
  cyclic(OdriveCommand::kTorques, config_.torques_us);
}

void OdriveNode::advance(std::int64_t now_us) {
  now_us_ = now_us;
  while (next_step_us_ <= now_us) {
    step();
    next_step_us_ += step_us_;
  }
  if (booting_) {
    if (now_us < boot_done_us_) return;
    booting_ = false;
  }
  if (arming_done_us_ && now_us >= *arming_done_us_) {
    procedure_result_ = kProcedureSuccess;
    set_state(OdriveState::kClosedLoop);
  }
  if (config_.watchdog_enabled && watchdog_deadline_us_ && now_us >= *watchdog_deadline_us_) {
    watchdog_deadline_us_.reset();
    disarm(kOdriveWatchdogExpired);
  }
  send_cyclic();
}

std::int64_t OdriveNode::next_deadline_us() const {
  std::int64_t next = next_step_us_;
  if (booting_) return std::min(next, boot_done_us_);
  if (arming_done_us_) next = std::min(next, *arming_done_us_);
  if (config_.watchdog_enabled && watchdog_deadline_us_) next = std::min(next, *watchdog_deadline_us_);
  return next;  // cyclic messages are sent at the drive's steps
}

// Drive side. The drive's published cascade: proportional in position, proportional-integral in velocity.
double OdriveNode::wanted_torque_Nm() {
  double wanted_Nm = input_torque_Nm_;
  if (control_mode_ >= kVelocityControl) {
    double wanted_turns_s = input_velocity_turns_s_;
    if (control_mode_ == kPositionControl)
      wanted_turns_s += 0.25 * config_.velocity_bandwidth_rad_s * (input_position_turns_ - encoder_turns());
    // The inertia is at the joint, a turn is the encoder's.
    const double gain_Nm_per_turn_s = config_.velocity_bandwidth_rad_s * config_.plant.joint.inertia_kgm2 *
                                      2.0 * std::numbers::pi * config_.joint_turns_per_encoder_turn /
                                      config_.joint_torque_per_drive_torque;
    const double proportional_Nm = gain_Nm_per_turn_s * (wanted_turns_s - encoder_turns_s_);
    wanted_Nm += proportional_Nm + integral_Nm_;
    if (std::abs(wanted_Nm) < config_.torque_limit_Nm)
      integral_Nm_ += 0.5 * config_.velocity_bandwidth_rad_s * config_.plant.period_s * proportional_Nm;
  }
  return std::clamp(wanted_Nm, -config_.torque_limit_Nm, config_.torque_limit_Nm);
}

void OdriveNode::step() {
  const bool follows = state_ == OdriveState::kClosedLoop && control_mode_ >= kTorqueControl &&
                       control_mode_ <= kPositionControl && input_mode_ == kPassthrough;
  const double before_Nm = torque_Nm_;
  torque_Nm_ = follows ? wanted_torque_Nm() * config_.joint_torque_per_drive_torque : 0.0;
  if (!follows) integral_Nm_ = 0.0;
  if (notes_torque_ && (before_Nm != 0.0) != (torque_Nm_ != 0.0))
    output_.note(torque_Nm_ != 0.0 ? "torque on" : "torque zero");
  if (!follows) plant_.clear_pending_torque();
  const double before_turns = encoder_turns();
  plant_.step(torque_Nm_);
  plant_.set_ambient_temperature(config_.ambient.at(plant_.time_s()));
  const double turns_s = (encoder_turns() - before_turns) / plant_.config().period_s;
  encoder_turns_s_ += kVelocityShare * (turns_s - encoder_turns_s_);
  if (bus_V_ < config_.under_voltage_V && (errors_ & kOdriveUnderVoltage) == 0) disarm(kOdriveUnderVoltage);
  if (plant_.sensor_temperature_C() > config_.motor_limit_C && (errors_ & kOdriveMotorOverTemperature) == 0)
    disarm(kOdriveMotorOverTemperature);
  if (awaiting_rest_ && plant_.state().stuck) {
    awaiting_rest_ = false;
    output_.note(format("at-rest position_rad=%.6f", plant_.state().position_rad));
  }
}

std::string OdriveNode::report() const {
  const JointState& joint = plant_.state();
  return format("report state=%d errors=%08X disarm_reason=%08X control=%u input=%u inputs=%ld",
                static_cast<int>(state_), errors_, disarm_reason_, control_mode_, input_mode_, inputs_) +
         format(" position_rad=%.6f velocity_rad_s=%.6f torque_Nm=%.4f", joint.position_rad,
                joint.velocity_rad_s, torque_Nm_);
}

}  // namespace strainwave::can_nodes
