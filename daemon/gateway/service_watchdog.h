// SPDX-License-Identifier: BSD-3-Clause
// Tells a service manager that the gateway goes round: it ends one that hangs, which the core, another user, may not. Nothing
// without one. Made before the filter of system calls is loaded; what it does afterwards is sending. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

class ServiceWatchdog {
 public:
  ServiceWatchdog();
  ~ServiceWatchdog();
  ServiceWatchdog(const ServiceWatchdog&) = delete;
  ServiceWatchdog& operator=(const ServiceWatchdog&) = delete;

  /// The gateway works: what it promises from here on is watched.
  void ready() noexcept { send("READY=1"); }
  /// Called every turn; tells now and then.
  void alive(std::int64_t now_ns) noexcept;

 private:
  void send(const char* text) noexcept;

  int socket_ = -1;
  std::int64_t due_ns_ = 0;
};

}  // namespace strainwave
