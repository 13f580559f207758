// SPDX-License-Identifier: BSD-3-Clause
// Notifies a service manager that the gateway runs. The service manager ends a gateway that hangs; the core, as another user, may not.
// Does nothing without a service manager. Construct it before the filter of system calls is loaded: it only sends later. Not real-time.
#pragma once

#include <cstdint>

#include "base/unique_fd.h"

namespace strainwave {

class ServiceWatchdog {
 public:
  ServiceWatchdog();

  /// The gateway is ready: from now on the service manager expects alive().
  void ready() noexcept { send("READY=1"); }
  /// Call it every turn; it sends at most every 0.2 s.
  void alive(std::int64_t now_ns) noexcept;

 private:
  void send(const char* text) noexcept;

  UniqueFd socket_;
  std::int64_t due_ns_ = 0;
};

}  // namespace strainwave
