// SPDX-License-Identifier: BSD-3-Clause
// Start of the gateway by a service manager, under a separate user. The manager runs this program once for each connection to a
// socket to which only the daemon's user may connect. The core at the other end sends the descriptors that a child would inherit,
// and the gateway's program. This program then becomes that one: after an upgrade of the package, a running core keeps the gateway
// version that it knows. Not real-time.
#pragma once

namespace strainwave {

/// Whether the service manager started this process for a connection.
bool is_activated();

/// Moves the descriptors to their numbers (daemon/gateway/gateway_process.h) and becomes the core's gateway. Throws
/// std::system_error; does not return.
[[noreturn]] void become_gateway_of_core();

}  // namespace strainwave
