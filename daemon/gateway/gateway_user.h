// SPDX-License-Identifier: BSD-3-Clause
// As which user the gateway runs when root starts the daemon. Not real-time.
#pragma once

#include <cstdint>
#include <string>

namespace strainwave {

struct GatewayUser {
  std::int64_t uid = -1;  ///< -1: as the daemon itself
  std::int64_t gid = -1;
  std::string name;  ///< empty: as the daemon itself
};

/// The user that the configuration names. Throws InputError: there is none, it is root, or the daemon may not
/// change users.
GatewayUser gateway_user_named(const std::string& name);

/// When root: "strainwave-gateway" if it exists, else "nobody"; otherwise, or in a user namespace without
/// them, the daemon's own.
GatewayUser default_gateway_user();

/// A daemon that is not root has a gateway of its own user when it starts it itself. This keeps the gateway, and whatever else that
/// user runs, from reading and writing the daemon's memory through /proc and from tracing it.
void hide_memory_from_own_user();

}  // namespace strainwave
