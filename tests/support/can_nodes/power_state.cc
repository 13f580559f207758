// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/power_state.h"

namespace strainwave::can_nodes {

namespace {

enum class Order { kNothing, kShutdown, kSwitchOn, kEnableOperation, kDisableVoltage, kQuickStop };

// Bits 0 to 3: switch on, enable voltage, quick stop (active low), enable operation.
Order order_of(std::uint16_t controlword) {
  if ((controlword & 0x02) == 0) return Order::kDisableVoltage;
  if ((controlword & 0x04) == 0) return Order::kQuickStop;
  if ((controlword & 0x01) == 0) return Order::kShutdown;
  return (controlword & 0x08) == 0 ? Order::kSwitchOn : Order::kEnableOperation;
}

PowerState from_ready(Order order) {
  switch (order) {
    case Order::kSwitchOn:
    case Order::kEnableOperation:  // transitions 3 and 4 one after the other
      return PowerState::kSwitchedOn;
    case Order::kDisableVoltage:
    case Order::kQuickStop:
      return PowerState::kSwitchOnDisabled;
    default:
      return PowerState::kReadyToSwitchOn;
  }
}

PowerState from_switched_on(Order order) {
  switch (order) {
    case Order::kShutdown:
      return PowerState::kReadyToSwitchOn;
    case Order::kEnableOperation:
      return PowerState::kOperationEnabled;
    case Order::kDisableVoltage:
    case Order::kQuickStop:
      return PowerState::kSwitchOnDisabled;
    default:
      return PowerState::kSwitchedOn;
  }
}

PowerState from_enabled(Order order) {
  switch (order) {
    case Order::kShutdown:
      return PowerState::kReadyToSwitchOn;
    case Order::kSwitchOn:
      return PowerState::kSwitchedOn;
    case Order::kDisableVoltage:
      return PowerState::kSwitchOnDisabled;
    case Order::kQuickStop:
      return PowerState::kQuickStopActive;
    default:
      return PowerState::kOperationEnabled;
  }
}

}  // namespace

PowerState commanded_state(PowerState state, std::uint16_t controlword, std::uint16_t previous,
                           bool quick_stop_stays) {
  const Order order = order_of(controlword);
  const bool reset_edge = (controlword & 0x80) != 0 && (previous & 0x80) == 0;
  switch (state) {
    case PowerState::kSwitchOnDisabled:
      return order == Order::kShutdown ? PowerState::kReadyToSwitchOn : state;
    case PowerState::kReadyToSwitchOn:
      return from_ready(order);
    case PowerState::kSwitchedOn:
      return from_switched_on(order);
    case PowerState::kOperationEnabled:
      return from_enabled(order);
    case PowerState::kQuickStopActive:
      if (order == Order::kDisableVoltage) return PowerState::kSwitchOnDisabled;
      return order == Order::kEnableOperation && quick_stop_stays ? PowerState::kOperationEnabled : state;
    case PowerState::kFault:
      return reset_edge ? PowerState::kSwitchOnDisabled : state;
    case PowerState::kNotReadyToSwitchOn:
    case PowerState::kFaultReactionActive:
      break;
  }
  return state;
}

std::uint16_t status_bits(PowerState state) {
  switch (state) {
    case PowerState::kNotReadyToSwitchOn:
      return 0x00;
    case PowerState::kSwitchOnDisabled:
      return 0x40;
    case PowerState::kReadyToSwitchOn:
      return 0x21;
    case PowerState::kSwitchedOn:
      return 0x23;
    case PowerState::kOperationEnabled:
      return 0x27;
    case PowerState::kQuickStopActive:
      return 0x07;
    case PowerState::kFaultReactionActive:
      return 0x0F;
    case PowerState::kFault:
      return 0x08;
  }
  return 0x00;
}

const char* to_text(PowerState state) {
  switch (state) {
    case PowerState::kNotReadyToSwitchOn:
      return "NotReadyToSwitchOn";
    case PowerState::kSwitchOnDisabled:
      return "SwitchOnDisabled";
    case PowerState::kReadyToSwitchOn:
      return "ReadyToSwitchOn";
    case PowerState::kSwitchedOn:
      return "SwitchedOn";
    case PowerState::kOperationEnabled:
      return "OperationEnabled";
    case PowerState::kQuickStopActive:
      return "QuickStopActive";
    case PowerState::kFaultReactionActive:
      return "FaultReactionActive";
    case PowerState::kFault:
      return "Fault";
  }
  return "?";
}

}  // namespace strainwave::can_nodes
