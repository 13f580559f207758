// What a refusal of the loop means for whoever gave the order: the mode that it met, the number that stood in its way, and the way on. In
// words. Not real-time.
#pragma once

#include <string>

#include "daemon/realtime/orders.h"

namespace strainwave {

/// Of a reply that is none of acceptance.
std::string refusal_advice(const Reply& reply, OrderKind kind);

}  // namespace strainwave
