// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/odrive/odrive_node.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"
#include "base/input_error.h"
#include "drivers/can/can_detail.h"
#include "drivers/can/odrive/odrive_order.h"
#include "drivers/can/odrive/odrive_setup.h"

namespace strainwave::odrive {

namespace {

/// Interval at which a state order is repeated until the heartbeat shows the new state.
constexpr std::int64_t kRepeatStateAfter_ns = 50'000'000;

ActuatorFault fault_of(std::uint32_t errors) noexcept {
  if ((errors & kEstopRequested) != 0) return ActuatorFault::kEmergencyStop;
  if ((errors & (kOverVoltage | kUnderVoltage)) != 0) return ActuatorFault::kPowerLost;
  return ActuatorFault::kDriveFault;
}

}  // namespace

std::string drive_error_text(std::uint32_t drive_error) {
  if ((drive_error & kOurDetail) == 0) return error_text(drive_error);
  const std::uint32_t detail = drive_error & ~kOurDetail;
  switch (detail_of(detail)) {
    case CanDetail::kEnableStep:
      return "the axis did not reach closed loop; it is in state " + std::to_string(detail_value_of(detail));
    case CanDetail::kLeftOperation:
      return "the axis left closed loop by itself, to state " + std::to_string(detail_value_of(detail));
    default:
      return can_detail_text(detail);
  }
}

Node::Node(const DriveConfig& config)
    : config_(config),
      arm_timeout_ns_(nanoseconds(config.arm_timeout_s)),
      period_ns_(nanoseconds(config.period_s)),
      kernel_clock_(period_ns_),
      watch_(nanoseconds(config.heartbeat_timeout_s), kOurDetail) {}

std::vector<std::uint32_t> Node::receive_ids() const {
  std::vector<std::uint32_t> ids;
  for (const Command command : {Command::kHeartbeat, Command::kEstimates, Command::kTemperatures})
    ids.push_back(can_id(command, config_.node_id));
  if (closes_loop(config_.drive_mode)) ids.push_back(can_id(Command::kTorques, config_.node_id));
  return ids;
}

std::vector<std::uint32_t> Node::transmit_ids() const {
  std::vector<std::uint32_t> ids;
  for (const Command command : {order_command(config_.drive_mode), Command::kSetAxisState,
                                Command::kSetControllerMode, Command::kClearErrors})
    ids.push_back(can_id(command, config_.node_id));
  return ids;
}

std::vector<std::uint32_t> Node::setup_ids() const {
  std::vector<std::uint32_t> ids = receive_ids();
  for (const Command command : {Command::kVersion, Command::kParameter})
    ids.push_back(can_id(command, config_.node_id));
  return ids;
}

std::vector<FrameTraffic> Node::traffic() const {
  const double rate_Hz = 1.0 / config_.period_s;
  std::vector<FrameTraffic> traffic{{"order of " + config_.name, order_frame(config_, {}).size, rate_Hz},
                                    {"encoder of " + config_.name, 8, rate_Hz},
                                    {"heartbeat of " + config_.name, 8, 1.0 / config_.heartbeat_period_s}};
  if (config_.temperature != TemperatureSource::kNone)
    traffic.push_back({"temperature of " + config_.name, 8, 1.0 / config_.temperature_period_s});
  if (closes_loop(config_.drive_mode)) traffic.push_back({"torque of " + config_.name, 8, rate_Hz});
  return traffic;
}

std::vector<std::string> Node::set_up(CanPort& port) {
  std::vector<std::string> report = check_axis(port, config_);
  release_axis(port, config_);
  setup_.end(true);
  return report;
}

std::vector<std::string> Node::verify(CanPort& port) {
  verify_axis(port, config_);
  return {};
}

std::vector<std::string> Node::serve(CanPort& port) {
  if (!setup_.begin()) return {};
  try {
    // Only the loop may send orders. It would take ours, from another socket, for those of a foreign sender.
    std::vector<std::string> messages = check_axis(port, config_);
    messages.push_back(config_.name + ": set up again");
    setup_.end(true);
    return messages;
  } catch (const InputError& error) {
    setup_.end(false);
    return {error.what()};
  }
}

void Node::shut_down(CanPort& port) noexcept {
  try {
    release_axis(port, config_);
  } catch (const std::exception&) {
    // If the drive cannot be reached, its watchdog stops it.
  }
}

void Node::begin_cycle(std::int64_t now_ns) noexcept {
  now_ns_ = now_ns;
  fresh_ = false;
  if (setup_.look()) forget_drive();
}

void Node::forget_drive() noexcept {
  heartbeat_ = {};
  heartbeat_ns_ = now_ns_;
  watch_.hear(now_ns_);
  missed_ = 0;
  sampled_ns_ = now_ns_ - 2 * period_ns_;
  kernel_clock_.restart();
  has_heartbeat_ = has_temperature_ = was_armed_ = stop_ordered_ = false;
}

void Node::note_own(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept {
  if (frame.id == can_id(order_command(config_.drive_mode), config_.node_id))
    kernel_clock_.echoed(kernel_time_ns);
}

void Node::receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept {
  if (!setup_.ready()) return;
  const auto is = [&](Command command) { return frame.id == can_id(command, config_.node_id); };
  if (is(Command::kEstimates)) {
    if (const auto estimates = decode_estimates(frame)) {
      position_rad_ = joint_position_rad(config_.units, estimates->position_turns);
      velocity_rad_s_ = joint_rad(config_.units, estimates->velocity_turns_s);
      fresh_ = true;
      sampled_ns_ = kernel_clock_.loop_time_ns(kernel_time_ns).value_or(now_ns_);
      // A position is neither from the future nor older than the last cycle, so another time is an error.
      if (position_age_ns() < 0 || position_age_ns() > 2 * period_ns_) sampled_ns_ = now_ns_;
      return;
    }
  } else if (is(Command::kHeartbeat)) {
    if (const auto heartbeat = decode_heartbeat(frame)) {
      heartbeat_ = *heartbeat;
      heartbeat_ns_ = now_ns_;
      watch_.hear(now_ns_);
      has_heartbeat_ = true;
      return;
    }
  } else if (is(Command::kTorques)) {
    if (const auto torque_Nm = decode_torque_Nm(frame)) {
      torque_measured_Nm_ = joint_torque_Nm(config_.units, *torque_Nm);
      torque_ns_ = now_ns_;
    }
  } else if (const auto temperatures = decode_temperatures(frame)) {
    const auto temperature_C = joint_temperature_C(config_.temperature, *temperatures);
    if (!temperature_C) return;
    temperature_C_ = *temperature_C;
    temperature_ns_ = now_ns_;
    has_temperature_ = true;
  }
}

void Node::note_bus(const NodeFault& trouble) noexcept {
  watch_.note_bus(trouble);
}

ActuatorReading Node::read(std::int64_t /*now_ns*/) noexcept {
  supervise();
  const NodeFault shown = watch_.shown(watch_.connection_trouble(setup_, now_ns_));
  ActuatorReading reading;
  reading.joint_position_rad = position_rad_ + velocity_rad_s_ * seconds(position_age_ns());
  reading.joint_velocity_rad_s = velocity_rad_s_;
  reading.has_position = reading.has_velocity = has_position();
  // The drive may have restarted while it was unreachable; it sends no message about that.
  reading.position_lost = !config_.absolute_encoder &&
                          (!setup_.ready() || watch_.latched_fault().fault == ActuatorFault::kConnectionLost);
  reading.torque_measured = closes_loop(config_.drive_mode) && now_ns_ - torque_ns_ < 2 * period_ns_;
  if (closes_loop(config_.drive_mode))
    reading.torque_applied_Nm = reading.torque_measured ? torque_measured_Nm_ : 0.0;
  else
    reading.torque_applied_Nm = closed_loop() ? sent_.torque_Nm : 0.0;
  reading.has_temperature = has_temperature_;
  reading.temperature_C = temperature_C_;
  reading.temperature_produced_ns = temperature_ns_;
  if (shown.fault != ActuatorFault::kNone && command_.enable)
    reading.drive_state = DriveState::kFault;
  else if (command_.enable)
    reading.drive_state =
        closed_loop() && has_position() && !stop_ordered_ ? DriveState::kEnabled : DriveState::kEnabling;
  else
    reading.drive_state = closed_loop() ? DriveState::kEnabled : DriveState::kDisabled;
  reading.fault = shown.fault;
  reading.drive_error = shown.fault != ActuatorFault::kNone ? shown.drive_error : heartbeat_.errors;
  return reading;
}

// Drive and loop have separate clocks of nearly one period: sometimes a cycle gets no position and the next one gets two.
bool Node::has_position() const noexcept {
  return fresh_ || (missed_ <= 1 && position_age_ns() < 2 * period_ns_);
}

void Node::supervise() noexcept {
  missed_ = fresh_ ? 0 : std::min(missed_ + 1, config_.fault_after + 1);
  if (!command_.enable) return;
  // No orders fed the idle drive's watchdog before this loop began. The operator's enable order also clears that error.
  if (heartbeat_.errors == kWatchdogExpired && !was_armed_ && !closed_loop()) clear_ordered_ = true;
  watch_.latch(watch_.connection_trouble(setup_, now_ns_));
  watch_.latch(use_trouble());
  was_armed_ = was_armed_ || closed_loop();
}

// Faults that concern only a drive in use.
NodeFault Node::use_trouble() const noexcept {
  const auto state = static_cast<std::uint32_t>(heartbeat_.state);
  if (heartbeat_.errors != 0 && !clear_ordered_) return {fault_of(heartbeat_.errors), heartbeat_.errors};
  if (missed_ > config_.fault_after)
    return watch_.trouble(ActuatorFault::kReadFailed, CanDetail::kPositionMissing);
  if (was_armed_ && !closed_loop())
    return watch_.trouble(ActuatorFault::kDriveFault, CanDetail::kLeftOperation, state);
  if (!was_armed_ && enabling_since_ns_ != 0 && now_ns_ - enabling_since_ns_ > arm_timeout_ns_)
    return watch_.trouble(ActuatorFault::kDriveFault, CanDetail::kEnableStep, state);
  return {};
}

void Node::write(const ActuatorCommand& command) noexcept {
  if (command.enable && !command_.enable) {
    enabling_since_ns_ = now_ns_;
    was_armed_ = false;
  }
  command_ = command;
  const double sum = command.torque_Nm + command.motor_position_rad + command.motor_velocity_rad_s;
  if (command_.enable && !std::isfinite(sum))
    watch_.latch(watch_.trouble(ActuatorFault::kWriteRefused, CanDetail::kNone));
}

bool Node::wants_power() const noexcept {
  return command_.enable && !stop_ordered_ && !watch_.latched();
}

void Node::transmit(CanTransmitter& bus) noexcept {
  if (!setup_.ready()) return;
  lead_state(bus);
  // Without positions, a drive that closes its own loop continues with the trajectory; a torque-controlled drive must not.
  const bool driven = wants_power() && closed_loop() &&
                      (closes_loop(config_.drive_mode) || missed_ <= config_.zero_torque_after);
  // The order holds the present position, so that the joint does not jump when it is enabled.
  sent_ = driven ? command_ : ActuatorCommand{0.0, false, position_rad_, 0.0};
  sent_.torque_Nm = std::clamp(sent_.torque_Nm, -config_.torque_limit_Nm, config_.torque_limit_Nm);
  // Sent in every period, also when disabled: it feeds the drive's watchdog, and its echo gives the kernel's time.
  kernel_clock_.sent(now_ns_);
  (void)bus.send(order_frame(config_, sent_));
}

// Requests closed loop while power is wanted, else idle. Orders are limited in rate because the heartbeat
// shows the state late.
void Node::lead_state(CanTransmitter& bus) noexcept {
  if (clear_ordered_ && bus.send(clear_errors_frame(config_.node_id))) {
    clear_ordered_ = false;
    heartbeat_.errors = 0;  // the next heartbeat reports the errors that remain
  }
  if (stop_ordered_ && has_heartbeat_ && heartbeat_ns_ == now_ns_ && !closed_loop()) stop_ordered_ = false;
  const bool wanted = wants_power();
  if (has_heartbeat_ && closed_loop() == wanted) return;
  if (wanted && was_armed_) return;  // the axis left closed loop by itself, which is a fault
  // Removing the power does not wait.
  const bool urgent = !wanted && sent_.enable;
  if (!urgent && now_ns_ - state_sent_ns_ < kRepeatStateAfter_ns) return;
  if (wanted) (void)bus.send(mode_frame(config_.node_id, control_mode(config_.drive_mode)));
  const bool sent =
      bus.send(axis_state_frame(config_.node_id, wanted ? AxisState::kClosedLoop : AxisState::kIdle));
  // If the bus did not take the order, it is sent again in the next period.
  state_sent_ns_ = sent ? now_ns_ : now_ns_ - kRepeatStateAfter_ns;
}

void Node::clear_fault() noexcept {
  const bool was_away = watch_.latched_fault().fault == ActuatorFault::kConnectionLost || setup_.failed();
  watch_.clear();
  clear_ordered_ = true;
  was_armed_ = false;
  if (!was_away) return;
  // The node that answers now may be another drive, or have other settings.
  setup_.request();
}

}  // namespace strainwave::odrive
