// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_detail.h"

#include "drivers/can/canopen/canopen.h"
#include "drivers/can/cia402/cia402_state.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave {

namespace {

std::string status_text(std::uint32_t value) {
  const auto state = cia402::power_state_of(static_cast<std::uint16_t>(value));
  return "\"" + std::string(cia402::to_text(state)) + "\" (statusword " + hexadecimal(value, 4) + ")";
}

}  // namespace

std::string can_detail_text(std::uint32_t drive_error) {
  const std::uint32_t value = detail_value_of(drive_error);
  switch (detail_of(drive_error)) {
    case CanDetail::kNone:
      return "no detail";
    case CanDetail::kInterfaceDown:
      return "the CAN interface is down";
    case CanDetail::kInterfaceGone:
      return "the CAN interface has gone: plug it in and restart the daemon";
    case CanDetail::kFramesStuck:
      return "frames are not sent: no node acknowledges, the bus is full, or the interface goes down";
    case CanDetail::kBusOff:
      return "bus-off: set the interface down and up, then clear the fault";
    case CanDetail::kErrorPassive:
      return "the CAN controller is error-passive";
    case CanDetail::kForeignSender:
      return "another node sends our identifier " + hexadecimal(value, 4);
    case CanDetail::kHeartbeatMissing:
      return "the drive's heartbeat is missing";
    case CanDetail::kBootUp:
      return "unexpected boot-up message";
    case CanDetail::kNetworkState:
      return "the drive is " + std::string(canopen::to_text(static_cast<canopen::NmtState>(value & 0xFFU))) +
             " on the network";
    case CanDetail::kPositionMissing:
      return "the drive's positions are missing";
    case CanDetail::kWrongMode:
      return "the drive shows mode of operation " + std::to_string(static_cast<std::int8_t>(value & 0xFFU));
    case CanDetail::kEnableStep:
      return "the drive stayed in " + status_text(value) + " while it was being enabled";
    case CanDetail::kLeftOperation:
      return "the drive went to " + status_text(value) + " by itself";
    case CanDetail::kFaultState:
      return "the drive is in " + status_text(value) + " and has sent no emergency";
    case CanDetail::kSetupFailed:
      return "the drive could not be set up, see above";
    case CanDetail::kFlooded:
      return "more frames arrive than the daemon can read in a period";
    case CanDetail::kPositionLate:
      return "positions come " + std::to_string(value) +
             " us after their SYNC, later than delay_periods allows";
    case CanDetail::kNotFollowing:
      return "the drive does not follow its torque order, " + status_text(value);
    case CanDetail::kQueueFull:
      return "the interface's queue is full";
  }
  return "unknown detail";
}

}  // namespace strainwave
