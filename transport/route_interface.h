// SPDX-License-Identifier: BSD-3-Clause
// Which interface the system's routes lead a group's datagrams to. It changes when an adapter is taken away and comes back, also under
// the same name and address, and when a route moves. Not real-time.
#pragma once

#include <netinet/in.h>

namespace strainwave {

/// Its index; 0: there is no route at present, or the system does not tell.
int route_interface(const in_addr& group) noexcept;

}  // namespace strainwave
