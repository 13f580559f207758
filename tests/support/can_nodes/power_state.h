// SPDX-License-Identifier: BSD-3-Clause
// The finite state automaton of a simulated servo drive: what a controlword does in which state, and how the
// statusword shows the state. Source: CiA 402-2 (IEC 61800-7-201), tables of transitions, of command coding
// and of state coding.
#pragma once

#include <cstdint>

namespace strainwave::can_nodes {

enum class PowerState {
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
};

/// The state that `controlword` asks for in `state`; the same state when it asks for nothing that is allowed.
/// `previous` is the controlword before it: a fault is reset by a rising edge of bit 7.
/// `quick_stop_stays`: quick stop option code 5 to 8, which lets operation be enabled again (transition 16).
PowerState commanded_state(PowerState state, std::uint16_t controlword, std::uint16_t previous,
                           bool quick_stop_stays);

/// Bits 0 to 6 of the statusword.
std::uint16_t status_bits(PowerState state);

const char* to_text(PowerState state);

}  // namespace strainwave::can_nodes
