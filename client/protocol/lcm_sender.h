// SPDX-License-Identifier: BSD-3-Clause
// Sends to LCM's network for a program with its own receiver. Not real-time.
#pragma once

#include <string>

#include "client/protocol/pending_order.h"

namespace strainwave {

/// Sends on the network of `lcm_url`, which must have passed find_udpm_defect(). A message that LCM rejects is lost,
/// as in the network, so the caller repeats important messages. Throws InputError when LCM cannot send there.
PendingOrder::Publish lcm_sender(const std::string& lcm_url);

}  // namespace strainwave
