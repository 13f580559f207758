// SPDX-License-Identifier: BSD-3-Clause
// Chooses the user of the gateway when root starts the daemon. Not real-time.
#pragma once

#include <cstdint>
#include <string>

namespace strainwave {

struct GatewayUser {
  std::int64_t uid = -1;  ///< -1: that of the daemon
  std::int64_t gid = -1;
  std::string name;  ///< empty: that of the daemon
};

/// The user that the configuration names. Throws InputError if there is none, if it is root, or if the daemon may
/// not change users.
GatewayUser gateway_user_named(const std::string& name);

/// When root: "strainwave-gateway" if it exists, else "nobody"; otherwise, or in a user namespace without
/// them, the daemon's own.
GatewayUser default_gateway_user();

/// Keeps the gateway and other programs of the same user from tracing the daemon and from accessing its memory through /proc. A
/// daemon that is not root starts its gateway under its own user.
void hide_memory_from_own_user();

}  // namespace strainwave
