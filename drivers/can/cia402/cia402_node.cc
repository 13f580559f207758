// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_node.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace strainwave::cia402 {

namespace {

using canopen::CobId;
using canopen::NmtState;

// Upper limit of skipped SYNCs; no estimator looks back that far.
constexpr std::int64_t kMostSkipped = 1000;

/// The first field of RPDO1.
constexpr PdoLayout::Field kControlwordField{1, 0, 2};

// 60FDh
constexpr std::uint32_t kNegativeLimitBit = 1U << 0U;
constexpr std::uint32_t kPositiveLimitBit = 1U << 1U;
constexpr std::uint32_t kHomeBit = 1U << 2U;

std::uint64_t raw_field(const CanFrame& frame, const PdoLayout::Field& field) noexcept {
  return little_endian(&frame.bytes[field.offset], field.bytes);
}

}  // namespace

std::string drive_error_text(std::uint32_t drive_error) {
  return detail_of(drive_error) == CanDetail::kNone ? canopen::drive_error_text(drive_error)
                                                    : can_detail_text(drive_error);
}

void Node::begin_cycle(std::int64_t now_ns) noexcept {
  skipped_syncs_ =
      now_ns_ > 0
          ? static_cast<int>(std::clamp<std::int64_t>((now_ns - now_ns_) / period_ns_ - 1, 0, kMostSkipped))
          : 0;
  now_ns_ = now_ns;
  fresh_ = false;
  if (setup_.look()) forget_drive();
}

// Resets the loop's state of a drive that has just been set up.
void Node::forget_drive() noexcept {
  power_.restart();
  // The operator's order to clear a fault caused this set-up, so it also resets a fault of the drive.
  if (std::exchange(clear_ordered_, false)) power_.begin_reset(now_ns_);
  position_scale_ = PositionScale(config_.units);
  probe_.restart();
  restarted_ = {};
  emergency_ = initial_error_;
  watch_.hear(now_ns_);
  last_resort_.end();
  age_.restart(sync_to_position_ns_);
  late_samples_ = 0;
  missed_ = 0;
  has_status_ = has_pdo_temperature_ = wrong_mode_ = stop_ordered_ = false;
}

void Node::receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept {
  if (!setup_.ready()) return;
  if (frame.id == layout_.fast.cob_id(config_.node_id)) {
    judge_age(kernel_time_ns);
    return receive_pdo(layout_.fast, frame);
  }
  if (frame.id == layout_.slow.cob_id(config_.node_id)) {
    age_.slow_sample(kernel_time_ns);
    return receive_pdo(layout_.slow, frame);
  }
  if (!layout_.probe.objects.empty() && frame.id == layout_.probe.cob_id(config_.node_id))
    return receive_probe(frame);
  if (frame.id == cob_id(CobId::kEmergency, config_.node_id)) {
    if (const auto emergency = canopen::decode_emergency(frame)) return receive_emergency(*emergency);
  } else if (const auto state = canopen::decode_heartbeat(frame)) {
    return receive_heartbeat(*state);
  }
}

// A position that is late occasionally only shows a busy bus. One that stays late misleads the control law,
// which assumes a newer one.
void Node::judge_age(std::int64_t kernel_time_ns) noexcept {
  age_.sample(kernel_time_ns);
  const bool late =
      config_.daemon_sends_sync && (age_.displaced() || age_.delay_ns() > config_.delay_periods * period_ns_);
  late_samples_ = late ? std::min(late_samples_ + 1, config_.zero_torque_after + 1) : 0;
}

void Node::receive_pdo(const canopen::Pdo& pdo, const CanFrame& frame) noexcept {
  if (frame.size != pdo.bytes()) return;
  const auto has = [&](const PdoLayout::Field& field) { return field.pdo == pdo.number; };
  if (has(layout_.statusword)) {
    power_.see(static_cast<std::uint16_t>(raw_field(frame, layout_.statusword)), now_ns_);
    has_status_ = true;
    if (power_.state() != PowerState::kOperationEnabled) followed_ = false;
    if (following() || power_.state() != PowerState::kOperationEnabled) followed_ns_ = now_ns_;
    if (following()) followed_ = true;
  }
  if (has(layout_.torque))
    torque_applied_Nm_ = torque_scale_.torque_Nm(static_cast<std::int16_t>(raw_field(frame, layout_.torque)));
  if (has(layout_.velocity))
    velocity_rad_s_ =
        position_scale_.velocity_rad_s(static_cast<std::int32_t>(raw_field(frame, layout_.velocity)));
  if (has(layout_.inputs)) {
    const std::uint64_t bits = raw_field(frame, layout_.inputs);
    inputs_.negative_limit = config_.inputs.negative_limit && (bits & kNegativeLimitBit) != 0;
    inputs_.positive_limit = config_.inputs.positive_limit && (bits & kPositiveLimitBit) != 0;
    inputs_.home = config_.inputs.home && (bits & kHomeBit) != 0;
  }
  if (has(layout_.mode)) see_mode(static_cast<std::uint8_t>(raw_field(frame, layout_.mode)));
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

void Node::see_mode(std::uint8_t mode) noexcept {
  shown_mode_ = mode;
  wrong_mode_ = mode != static_cast<std::uint8_t>(mode_);
}

void Node::receive_probe(const CanFrame& frame) noexcept {
  if (frame.size != layout_.probe.bytes()) return;
  if (!probe_.see(static_cast<std::uint16_t>(raw_field(frame, layout_.probe_status)))) return;
  ++inputs_.index_count;
  inputs_.index_position_rad =
      position_scale_.elsewhere_rad(static_cast<std::int32_t>(raw_field(frame, layout_.probe_position)));
}

void Node::receive_heartbeat(NmtState state) noexcept {
  watch_.hear(now_ns_);
  const bool boot_up = state == NmtState::kBootUp;
  if (boot_up) {
    last_resort_.hear_boot_up();
    power_.restart();
  } else {
    last_resort_.hear(now_ns_);
  }
  if (state == NmtState::kOperational || restarted_.fault != ActuatorFault::kNone) return;
  restarted_ =
      watch_.trouble(ActuatorFault::kDriveRestarted, boot_up ? CanDetail::kBootUp : CanDetail::kNetworkState,
                     static_cast<std::uint32_t>(state));
}

ActuatorReading Node::read(std::int64_t /*now_ns*/) noexcept {
  if (std::uint8_t mode = 0; setup_.ready() && reads_mode() && sdo_mode_.take(mode)) see_mode(mode);
  supervise();
  const NodeFault shown = watch_.shown(present_trouble());
  ActuatorReading reading;
  // An incremental encoder starts to count where the drive was switched on.
  reading.position_lost = !config_.absolute_encoder && (!setup_.ready() || setup_.must_be_repeated() ||
                                                        restarted_.fault != ActuatorFault::kNone);
  reading.joint_position_rad = position_rad_;
  reading.has_position = fresh_;
  reading.position_delay_ns = fresh_ ? age_.delay_ns() : 0;
  reading.position_late_periods = age_.late_periods(config_.daemon_sends_sync ? skipped_syncs_ : 0);
  reading.joint_velocity_rad_s = velocity_rad_s_;
  reading.has_velocity = fresh_ && layout_.velocity.pdo != 0;
  reading.torque_applied_Nm = torque_applied_Nm_;
  reading.torque_measured = layout_.torque.pdo != 0;
  fill_temperature(reading);
  reading.inputs = inputs_;
  reading.drive_state = drive_state();
  reading.fault = shown.fault;
  reading.drive_error = shown.fault != ActuatorFault::kNone ? shown.drive_error : emergency_;
  return reading;
}

void Node::fill_temperature(ActuatorReading& reading) const noexcept {
  if (!config_.temperature) return;
  if (reads_temperature()) {
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
  const double sum = command.torque_Nm + command.motor_position_rad + command.motor_velocity_rad_s;
  if (command_.enable && !std::isfinite(sum))
    watch_.latch(watch_.trouble(ActuatorFault::kWriteRefused, CanDetail::kNone));
}

Goal Node::goal() const noexcept {
  if (watch_.latched() || stop_ordered_) return Goal::kQuickStop;
  return command_.enable ? Goal::kEnabled : Goal::kDisabled;
}

void Node::transmit(CanTransmitter& bus) noexcept {
  // A drive that reported a restart gets the stop order, too. If it has not restarted, it still has torque;
  // if it has, it ignores PDOs.
  if (!setup_.ready()) return;
  transmit_order(bus);
  if (last_resort_.due(now_ns_) && bus.send(last_resort_.frame())) last_resort_.sent(now_ns_);
  // A stop is complete when the drive reports that it has no torque.
  if (fresh_ && has_status_ && !power_.has_torque()) stop_ordered_ = false;
}

// Without positions, a drive that closes its own loop continues with its orders; a torque-controlled drive must not.
void Node::transmit_order(CanTransmitter& bus) noexcept {
  const Goal wanted = goal();
  std::uint16_t controlword = power_.controlword(wanted, now_ns_);
  const bool driven = wanted == Goal::kEnabled && power_.state() == PowerState::kOperationEnabled &&
                      controlword == controlword::kEnableOperation &&
                      (closes_loop(config_.drive_mode) || missed_ <= config_.zero_torque_after);
  if (driven && mode_ == OperationMode::kInterpolatedPosition) controlword |= controlword::kInterpolate;
  std::array<CanFrame, 2> frames{};
  const auto put = [&frames](const PdoLayout::Field& field, std::uint64_t value) {
    if (field.pdo != 0)
      put_little_endian(&frames[static_cast<std::size_t>(field.pdo) - 1].bytes[field.offset], field.bytes,
                        value);
  };
  put(kControlwordField, controlword);
  put(layout_.probe_function, probe_.function());
  put(closes_loop(config_.drive_mode) ? layout_.torque_offset : layout_.target,
      static_cast<std::uint16_t>(driven ? torque_scale_.per_mille(command_.torque_Nm) : std::int16_t{0}));
  if (config_.drive_mode == DriveMode::kPosition)
    put(layout_.target,
        static_cast<std::uint32_t>(driven ? position_scale_.counts(command_.motor_position_rad)
                                          : position_scale_.last_counts()));
  if (closes_loop(config_.drive_mode))
    put(config_.drive_mode == DriveMode::kVelocity ? layout_.target : layout_.velocity_offset,
        static_cast<std::uint32_t>(driven ? position_scale_.velocity_units(command_.motor_velocity_rad_s)
                                          : 0));
  for (const canopen::Pdo* pdo : {&layout_.offsets, &layout_.command}) {
    if (pdo->objects.empty()) continue;
    CanFrame& frame = frames[static_cast<std::size_t>(pdo->number) - 1];
    frame.id = pdo->cob_id(config_.node_id);
    frame.size = static_cast<std::uint8_t>(pdo->bytes());
    (void)bus.send(frame);
  }
}

void Node::clear_fault() noexcept {
  watch_.clear();
  if (!watch_.bus_is_well()) return;
  if (setup_.must_be_repeated()) {
    setup_.request();
    clear_ordered_ = true;
    has_status_ = false;
    power_.restart();
    return;
  }
  power_.begin_reset(now_ns_);
}

}  // namespace strainwave::cia402
