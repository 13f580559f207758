// SPDX-License-Identifier: BSD-3-Clause
// A network of the test's own: loopback with multicast, nothing else. Tests that use LCM then disturb neither each other
// nor the machine they run on.
#pragma once

namespace strainwave::testing {

/// Moves this process (before it starts threads) into a new network namespace with loopback and the LCM route. With
/// `with_route` false the route is left out: LCM is then not available. Returns false when the system does not allow it.
bool enter_private_network(bool with_route = true);

}  // namespace strainwave::testing
