// SPDX-License-Identifier: BSD-3-Clause
// Finds the interface to which the system routes a group's datagrams. It changes when an adapter is removed and comes back, even with
// the same name and address, and when a route moves. Not real-time.
#pragma once

#include <netinet/in.h>

namespace strainwave {

/// Returns the interface's index; 0: there is no route at present, or the system does not name it.
int route_interface(const in_addr& group) noexcept;

}  // namespace strainwave
