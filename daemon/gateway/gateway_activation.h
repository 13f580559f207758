// SPDX-License-Identifier: BSD-3-Clause
// How a service manager starts the gateway as a user of its own: it runs this program once for each connection to a socket of
// which only the daemon's user may make one. The core is at the other end and sends what the gateway inherits otherwise, and
// with it the gateway's program: after an upgrade of the package, a running core goes on with the gateway it knows. This program
// then becomes that one. Not real-time.
#pragma once

namespace strainwave {

/// The service manager has started this process for a connection.
bool is_activated();

/// Takes the descriptors to their places (daemon/gateway/gateway_process.h) and becomes the core's gateway. Throws
/// std::system_error; does not return.
[[noreturn]] void become_gateway_of_core();

}  // namespace strainwave
