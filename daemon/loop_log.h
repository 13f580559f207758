// SPDX-License-Identifier: BSD-3-Clause
// Writes the events of the real-time loop to the log. Not real-time.
#pragma once

#include "daemon/config/config.h"
#include "daemon/realtime/joint/orders.h"

namespace strainwave {

/// Whether `event` reports that a joint faulted.
bool tells_of_fault(const LoopEvent& event) noexcept;

/// Logs one line: a fault with its cause and the key of its limit, a yield with the load and its limit, or a change of mode.
void log_loop_event(const JointConfig& joint, const LoopEvent& event);

}  // namespace strainwave
