#include "drivers/can/cia402/cia402_node.h"

#include <algorithm>
#include <cmath>

namespace strainwave::cia402 {

namespace {

using canopen::CobId;
using canopen::NmtState;

/// Statusword bit 4: the supply of the power stage is there.
constexpr std::uint16_t kVoltageEnabled = 1U << 4U;
constexpr std::uint16_t kVoltageErrors = 0x3000;
constexpr std::uint16_t kErrorClass = 0xF000;

/// The fault that an emergency means: what begins with 3 is about the supply.
ActuatorFault fault_of_emergency(std::uint32_t emergency) noexcept {
  return (emergency & kErrorClass) == kVoltageErrors ? ActuatorFault::kPowerLost : ActuatorFault::kDriveFault;
}

std::uint64_t raw_field(const CanFrame& frame, const PdoLayout::Field& field) noexcept {
  return little_endian(&frame.bytes[field.offset], field.bytes);
}

}  // namespace

std::string drive_error_text(std::uint32_t drive_error) {
  return detail_of(drive_error) == CanDetail::kNone ? canopen::drive_error_text(drive_error)
                                                    : can_detail_text(drive_error);
}

void Node::begin_cycle(std::int64_t now_ns) noexcept {
  now_ns_ = now_ns;
  fresh_ = false;
  const SetUpState::State setup = setup_.now();
  const bool just_ready = setup == SetUpState::State::kReady && !setup_.ready();
  // Frames that this period finds may still be of the time before: they are not listened to.
  if (just_ready && !settling_) {
    settling_ = true;
    return;
  }
  settling_ = false;
  if (just_ready) forget_drive();
  setup_.see(setup);
}

// A drive that has just been set up starts anew for us as well.
void Node::forget_drive() noexcept {
  power_.restart();
  position_scale_ = PositionScale(config_.units);
  restarted_ = {};
  emergency_ = initial_error_;
  heartbeat_ns_ = now_ns_;
  missed_ = 0;
  has_status_ = has_pdo_temperature_ = wrong_mode_ = stop_ordered_ = needs_set_up_ = false;
}

void Node::receive(const CanFrame& frame) noexcept {
  if (!setup_.ready()) return;
  if (frame.id == layout_.fast.cob_id(config_.node_id)) return receive_pdo(layout_.fast, frame);
  if (frame.id == layout_.slow.cob_id(config_.node_id)) return receive_pdo(layout_.slow, frame);
  if (frame.id == cob_id(CobId::kEmergency, config_.node_id)) {
    if (const auto emergency = canopen::decode_emergency(frame)) return receive_emergency(*emergency);
  } else if (const auto state = canopen::decode_heartbeat(frame)) {
    return receive_heartbeat(*state);
  }
  ++malformed_;
}

void Node::receive_pdo(const canopen::Pdo& pdo, const CanFrame& frame) noexcept {
  if (frame.size != pdo.bytes()) {
    ++malformed_;
    return;
  }
  const auto has = [&](const PdoLayout::Field& field) { return field.pdo == pdo.number; };
  if (has(layout_.statusword)) {
    power_.see(static_cast<std::uint16_t>(raw_field(frame, layout_.statusword)), now_ns_);
    has_status_ = true;
  }
  if (has(layout_.torque))
    torque_applied_Nm_ = torque_scale_.torque_Nm(static_cast<std::int16_t>(raw_field(frame, layout_.torque)));
  if (has(layout_.velocity))
    velocity_rad_s_ =
        position_scale_.velocity_rad_s(static_cast<std::int32_t>(raw_field(frame, layout_.velocity)));
  if (has(layout_.mode)) {
    shown_mode_ = static_cast<std::uint8_t>(raw_field(frame, layout_.mode));
    wrong_mode_ = shown_mode_ != static_cast<std::uint8_t>(mode_);
  }
  if (has(layout_.temperature)) {
    pdo_temperature_C_ = temperature_C(*config_.temperature, raw_field(frame, layout_.temperature));
    pdo_temperature_ns_ = now_ns_;
    has_pdo_temperature_ = true;
  }
  if (has(layout_.position)) {
    position_rad_ =
        position_scale_.position_rad(static_cast<std::int32_t>(raw_field(frame, layout_.position)));
    fresh_ = true;
  }
}

void Node::receive_emergency(const canopen::Emergency& emergency) noexcept {
  emergency_ = emergency.code == 0 ? 0 : canopen::drive_error_of(emergency);
  if (emergency_ != 0 && command_.enable) latch({fault_of_emergency(emergency_), emergency_});
}

void Node::receive_heartbeat(NmtState state) noexcept {
  heartbeat_ns_ = now_ns_;
  if (state == NmtState::kOperational || restarted_.fault != ActuatorFault::kNone) return;
  const CanDetail detail = state == NmtState::kBootUp ? CanDetail::kBootUp : CanDetail::kNetworkState;
  restarted_ = {ActuatorFault::kDriveRestarted, drive_error_of(detail, static_cast<std::uint32_t>(state))};
}

ActuatorReading Node::read(std::int64_t /*now_ns*/) noexcept {
  supervise();
  const NodeFault present = present_trouble();
  const NodeFault& shown = latched_.fault != ActuatorFault::kNone ? latched_ : present;
  ActuatorReading reading;
  reading.joint_position_rad = position_rad_;
  reading.has_position = fresh_;
  reading.joint_velocity_rad_s = velocity_rad_s_;
  reading.has_velocity = fresh_ && layout_.velocity.pdo != 0;
  reading.torque_applied_Nm = torque_applied_Nm_;
  fill_temperature(reading);
  reading.drive_state = drive_state();
  reading.fault = shown.fault;
  reading.drive_error = shown.fault != ActuatorFault::kNone ? shown.drive_error : emergency_;
  return reading;
}

// Whoever was out of sight may have restarted, or left its network state, as the standard has it when we were
// out of its.
void Node::note_bus(const NodeFault& trouble) noexcept {
  bus_trouble_ = trouble;
  if (trouble.fault == ActuatorFault::kLinkLost || detail_of(trouble.drive_error) == CanDetail::kBusOff)
    needs_set_up_ = true;
}

void Node::supervise() noexcept {
  missed_ = fresh_ ? 0 : std::min(missed_ + 1, config_.quick_stop_after + 1);
  const NodeFault present = present_trouble();
  if (present.fault == ActuatorFault::kLinkLost || present.fault == ActuatorFault::kDriveRestarted)
    needs_set_up_ = true;
  if (!command_.enable) return;
  latch(present);
  latch(power_trouble());
}

// What holds as long as its cause lasts, in use or not.
NodeFault Node::present_trouble() const noexcept {
  if (bus_trouble_.fault != ActuatorFault::kNone) return bus_trouble_;
  if (setup_.failed()) return {ActuatorFault::kDriveRestarted, drive_error_of(CanDetail::kSetupFailed)};
  if (!setup_.ready()) return {};
  if (restarted_.fault != ActuatorFault::kNone) return restarted_;
  if (now_ns_ - heartbeat_ns_ > heartbeat_timeout_ns_)
    return {ActuatorFault::kLinkLost, drive_error_of(CanDetail::kHeartbeatMissing)};
  if (wrong_mode_) return {ActuatorFault::kWriteRefused, drive_error_of(CanDetail::kWrongMode, shown_mode_)};
  return {};
}

// What is a fault only of a drive that is in use.
NodeFault Node::power_trouble() const noexcept {
  if (missed_ > config_.quick_stop_after)
    return {ActuatorFault::kReadFailed, drive_error_of(CanDetail::kPositionMissing)};
  if (!has_status_ || power_.resetting()) return {};
  const std::uint16_t statusword = power_.statusword();
  if (power_.in_fault()) {
    if (emergency_ != 0) return {fault_of_emergency(emergency_), emergency_};
    return {ActuatorFault::kDriveFault, drive_error_of(CanDetail::kFaultState, statusword)};
  }
  if (power_.left_operation()) {
    const bool powered = (statusword & kVoltageEnabled) != 0;
    return {powered ? ActuatorFault::kDriveFault : ActuatorFault::kPowerLost,
            drive_error_of(CanDetail::kLeftOperation, statusword)};
  }
  if (power_.stuck(now_ns_))
    return {ActuatorFault::kDriveFault, drive_error_of(CanDetail::kEnableStep, statusword)};
  return {};
}

void Node::latch(const NodeFault& fault) noexcept {
  if (latched_.fault == ActuatorFault::kNone) latched_ = fault;
}

DriveState Node::drive_state() const noexcept {
  if (latched_.fault != ActuatorFault::kNone && power_.has_torque()) return DriveState::kFault;
  if (has_status_ && power_.in_fault()) return command_.enable ? DriveState::kFault : DriveState::kDisabled;
  if (command_.enable)
    return fresh_ && power_.state() == PowerState::kOperationEnabled && !stop_ordered_
               ? DriveState::kEnabled
               : DriveState::kEnabling;
  return power_.has_torque() ? DriveState::kEnabled : DriveState::kDisabled;
}

void Node::fill_temperature(ActuatorReading& reading) const noexcept {
  if (!config_.temperature) return;
  if (config_.temperature->way == TemperatureObject::Way::kSdo) {
    TemperatureSample sample;
    reading.has_temperature = sdo_temperature_.take(sample);
    reading.temperature_C = sample.temperature_C;
    reading.temperature_produced_ns = sample.produced_ns;
    return;
  }
  reading.has_temperature = has_pdo_temperature_;
  reading.temperature_C = pdo_temperature_C_;
  reading.temperature_produced_ns = pdo_temperature_ns_;
}

void Node::write(const ActuatorCommand& command) noexcept {
  command_ = command;
  if (command_.enable && !std::isfinite(command_.torque_Nm))
    latch({ActuatorFault::kWriteRefused, drive_error_of(CanDetail::kNone)});
}

Goal Node::goal() const noexcept {
  if (latched_.fault != ActuatorFault::kNone || stop_ordered_) return Goal::kQuickStop;
  return command_.enable ? Goal::kEnabled : Goal::kDisabled;
}

void Node::transmit(CanTransmitter& bus) noexcept {
  // A drive that said it restarted gets the order to stop, too: if it did not restart after all it still has torque, and if
  // it did it takes no PDO.
  if (!setup_.ready()) return;
  const Goal wanted = goal();
  const std::uint16_t controlword = power_.controlword(wanted, now_ns_);
  const bool driven = wanted == Goal::kEnabled && power_.state() == PowerState::kOperationEnabled &&
                      controlword == kEnableOperation && missed_ <= config_.zero_torque_after;
  const std::int16_t torque = driven ? torque_scale_.per_mille(command_.torque_Nm) : std::int16_t{0};
  CanFrame frame;
  frame.id = layout_.command.cob_id(config_.node_id);
  frame.size = static_cast<std::uint8_t>(layout_.command.bytes());
  put_little_endian(&frame.bytes[0], 2, controlword);
  put_little_endian(&frame.bytes[2], 2, static_cast<std::uint16_t>(torque));
  (void)bus.send(frame);
  // A stop is done when the drive says that it has no torque.
  if (fresh_ && has_status_ && !power_.has_torque()) stop_ordered_ = false;
}

void Node::clear_fault() noexcept {
  latched_ = {};
  if (bus_trouble_.fault != ActuatorFault::kNone) return;
  if (needs_set_up_ || setup_.failed()) {
    setup_.request();
    has_status_ = false;
    power_.restart();
    return;
  }
  power_.begin_reset(now_ns_);
}

}  // namespace strainwave::cia402
