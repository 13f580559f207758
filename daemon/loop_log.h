// SPDX-License-Identifier: BSD-3-Clause
// What the real-time loop tells of, as a line in the log. Not real-time.
#pragma once

#include "daemon/config/config.h"
#include "daemon/realtime/joint/orders.h"

namespace strainwave {

/// Whether `event` is that of a joint that faulted.
bool tells_of_fault(const LoopEvent& event) noexcept;

/// One line: a fault with its cause and where its limit is configured, a yield with the load and what was allowed, or a change of the mode.
void log_loop_event(const JointConfig& joint, const LoopEvent& event);

}  // namespace strainwave
