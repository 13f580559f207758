// SPDX-License-Identifier: BSD-3-Clause
// A network of the test's own with multicast on loopback only. Tests that use LCM then disturb neither each
// other nor the machine.
#pragma once

namespace strainwave::testing {

/// Moves this process, before it starts threads, into a new network namespace with loopback and the LCM route. If
/// `with_route` is false there is no route, and LCM is not available. Returns false if the system does not allow it.
bool enter_private_network(bool with_route = true);

}  // namespace strainwave::testing
