// SPDX-License-Identifier: BSD-3-Clause
// The way to LCM's network for a program that hears it otherwise. Not real-time.
#pragma once

#include <string>

#include "client/protocol/pending_order.h"

namespace strainwave {

/// Sends on the network of `lcm_url`, which must have passed find_udpm_defect(). What LCM does not take is lost as on the network: who sends
/// repeats what must arrive. Throws InputError when the system refuses.
PendingOrder::Publish lcm_sender(const std::string& lcm_url);

}  // namespace strainwave
