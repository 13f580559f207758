// SPDX-License-Identifier: BSD-3-Clause
// The text of a refusal by the loop: the mode of the joint, the number that was not allowed, and what to do. Not real-time.
#pragma once

#include <string>

#include "daemon/realtime/joint/orders.h"

namespace strainwave {

/// `reply` must be a refusal.
std::string refusal_advice(const Reply& reply, OrderKind kind);

}  // namespace strainwave
