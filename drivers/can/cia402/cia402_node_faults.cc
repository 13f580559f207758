// SPDX-License-Identifier: BSD-3-Clause
// The part of cia402_node.h that says what is a fault, and what the drive can do for us now.
#include <algorithm>

#include "drivers/can/cia402/cia402_node.h"

namespace strainwave::cia402 {

namespace {

/// Statusword bit 4: the supply of the power stage is there.
constexpr std::uint16_t kVoltageEnabled = 1U << 4U;
/// Bit 12, but in TQ: the drive follows what it is ordered.
constexpr std::uint16_t kFollowing = 1U << 12U;
/// Once it has followed; a statusword may be of the period before the order.
constexpr std::int64_t kNotFollowing_ns = 20'000'000;
constexpr std::uint16_t kVoltageErrors = 0x3000;
constexpr std::uint16_t kErrorClass = 0xF000;

/// The fault that an emergency means: what begins with 3 is about the supply.
ActuatorFault fault_of_emergency(std::uint32_t emergency) noexcept {
  return (emergency & kErrorClass) == kVoltageErrors ? ActuatorFault::kPowerLost : ActuatorFault::kDriveFault;
}

}  // namespace

void Node::receive_emergency(const canopen::Emergency& emergency) noexcept {
  emergency_ = emergency.code == 0 ? 0 : canopen::drive_error_of(emergency);
  if (emergency_ != 0 && command_.enable) watch_.latch({fault_of_emergency(emergency_), emergency_});
}

// Whoever was out of sight may have restarted, or left its network state, as the standard has it when we were
// out of its.
void Node::note_bus(const NodeFault& trouble) noexcept {
  watch_.note_bus(trouble);
  if (trouble.fault == ActuatorFault::kConnectionLost || detail_of(trouble.drive_error) == CanDetail::kBusOff)
    setup_.wear_out();
}

void Node::supervise() noexcept {
  missed_ = fresh_ ? 0 : std::min(missed_ + 1, config_.quick_stop_after + 1);
  const NodeFault present = present_trouble();
  if (present.fault == ActuatorFault::kConnectionLost || present.fault == ActuatorFault::kDriveRestarted)
    setup_.wear_out();
  if (out_of_reach() && (command_.enable || power_.has_torque())) {
    last_resort_.begin(now_ns_);
    setup_.wear_out();
  }
  if (!command_.enable) return;
  watch_.latch(present);
  watch_.latch(power_trouble());
  // What it is late by is measured from its set-up on.
  if (late()) setup_.wear_out();
}

// What tells of a lost network state or of missing positions is believed only while no position comes: one that comes with our
// SYNC shows that process data arrive.
bool Node::out_of_reach() const noexcept {
  return setup_.ready() && !fresh_ &&
         (missed_ > config_.quick_stop_after || restarted_.fault != ActuatorFault::kNone);
}

// What holds as long as its cause lasts, in use or not.
NodeFault Node::present_trouble() const noexcept {
  if (watch_.bus_is_well() && setup_.ready() && restarted_.fault != ActuatorFault::kNone) return restarted_;
  const NodeFault link = watch_.connection_trouble(setup_, now_ns_);
  if (link.fault != ActuatorFault::kNone || !setup_.ready()) return link;
  if (wrong_mode_) return watch_.trouble(ActuatorFault::kWriteRefused, CanDetail::kWrongMode, shown_mode_);
  return {};
}

bool Node::following() const noexcept {
  const bool shown = mode_ != OperationMode::kTorque && config_.following_bit;
  return power_.state() == PowerState::kOperationEnabled &&
         (!shown || (power_.statusword() & kFollowing) != 0);
}

// What is a fault only of a drive that is in use.
NodeFault Node::power_trouble() const noexcept {
  if (late())
    return watch_.trouble(
        ActuatorFault::kReadFailed, CanDetail::kPositionLate,
        static_cast<std::uint32_t>(std::min<std::int64_t>(age_.delay_ns() / 1000, kMaxCanDetailValue)));
  if (missed_ > config_.quick_stop_after)
    return watch_.trouble(ActuatorFault::kReadFailed, CanDetail::kPositionMissing);
  if (!has_status_ || power_.resetting()) return {};
  const std::uint16_t statusword = power_.statusword();
  if (power_.in_fault()) {
    if (emergency_ != 0) return {fault_of_emergency(emergency_), emergency_};
    return watch_.trouble(ActuatorFault::kDriveFault, CanDetail::kFaultState, statusword);
  }
  if (power_.left_operation()) {
    const bool powered = (statusword & kVoltageEnabled) != 0;
    return watch_.trouble(powered ? ActuatorFault::kDriveFault : ActuatorFault::kPowerLost,
                          CanDetail::kLeftOperation, statusword);
  }
  const std::int64_t allowed_ns = followed_ ? kNotFollowing_ns : step_timeout_ns_;
  if (power_.state() == PowerState::kOperationEnabled && now_ns_ - followed_ns_ > allowed_ns)
    return watch_.trouble(ActuatorFault::kDriveFault, CanDetail::kNotFollowing, statusword);
  if (power_.stuck(now_ns_))
    return watch_.trouble(ActuatorFault::kDriveFault, CanDetail::kEnableStep, statusword);
  return {};
}

DriveState Node::drive_state() const noexcept {
  if (watch_.latched() && power_.has_torque()) return DriveState::kFault;
  if (has_status_ && power_.in_fault()) return command_.enable ? DriveState::kFault : DriveState::kDisabled;
  if (command_.enable)
    return fresh_ && power_.state() == PowerState::kOperationEnabled && followed_ && !stop_ordered_
               ? DriveState::kEnabled
               : DriveState::kEnabling;
  return power_.has_torque() ? DriveState::kEnabled : DriveState::kDisabled;
}

}  // namespace strainwave::cia402
