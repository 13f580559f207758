// SPDX-License-Identifier: BSD-3-Clause
// The finite state automaton of a simulated servo drive: the effect of a controlword in each state, and the
// bits of the statusword. Source: CiA 402-2 (IEC 61800-7-201), tables of transitions, of command coding and
// of state coding.
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

/// The state that `controlword` requests in `state`, or the same state if it requests nothing that is
/// allowed. `previous` is the controlword before it: a rising edge of bit 7 resets a fault.
/// `quick_stop_stays`: quick stop option code 5 to 8, with which operation may be enabled again (transition 16).
PowerState commanded_state(PowerState state, std::uint16_t controlword, std::uint16_t previous,
                           bool quick_stop_stays);

/// Bits 0 to 6 of the statusword.
std::uint16_t status_bits(PowerState state);

const char* to_text(PowerState state);

}  // namespace strainwave::can_nodes
