// SPDX-License-Identifier: BSD-3-Clause
// The part of cia402_node.h that detects faults and derives the drive state.
#include <algorithm>

#include "drivers/can/cia402/cia402_node.h"

namespace strainwave::cia402 {

namespace {

/// Statusword bit 4: the power stage has its supply voltage.
constexpr std::uint16_t kVoltageEnabled = 1U << 4U;
/// Bit 12, except in TQ: the drive follows its setpoint.
constexpr std::uint16_t kFollowing = 1U << 12U;
/// Time allowed once the drive has followed; a statusword may be older than the order.
constexpr std::int64_t kNotFollowing_ns = 20'000'000;
constexpr std::uint16_t kVoltageErrors = 0x3000;
constexpr std::uint16_t kErrorClass = 0xF000;

/// Returns the fault for an emergency; codes that begin with 3 concern the supply.
ActuatorFault fault_of_emergency(std::uint32_t emergency) noexcept {
  return (emergency & kErrorClass) == kVoltageErrors ? ActuatorFault::kPowerLost : ActuatorFault::kDriveFault;
}

}  // namespace

void Node::receive_emergency(const canopen::Emergency& emergency) noexcept {
  emergency_ = emergency.code == 0 ? 0 : canopen::drive_error_of(emergency);
  if (emergency_ != 0 && command_.enable) watch_.latch({fault_of_emergency(emergency_), emergency_});
}

// While unreachable, the drive may have restarted or left its network state, as the standard prescribes when
// it misses our heartbeat.
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
  // The lateness is measured relative to set-up, so a late drive needs a new one.
  if (late()) setup_.wear_out();
}

// A lost network state or missing positions count only while no position comes. A position that answers our
// SYNC shows that process data arrive.
bool Node::out_of_reach() const noexcept {
  return setup_.ready() && !fresh_ &&
         (missed_ > config_.quick_stop_after || restarted_.fault != ActuatorFault::kNone);
}

// Faults that last as long as their cause, whether the drive is in use or not.
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

// Faults that concern only a drive in use.
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
