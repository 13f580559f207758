// SPDX-License-Identifier: BSD-3-Clause
// Tells a service manager that the gateway goes round: it ends one that hangs, which the core, another user, may not. Nothing
// without one. Made before the filter of system calls is loaded; what it does afterwards is sending. Not real-time.
#pragma once

#include <cstdint>

#include "base/unique_fd.h"

namespace strainwave {

class ServiceWatchdog {
 public:
  ServiceWatchdog();

  /// The gateway works: what it promises from here on is watched.
  void ready() noexcept { send("READY=1"); }
  /// Called every turn; tells now and then.
  void alive(std::int64_t now_ns) noexcept;

 private:
  void send(const char* text) noexcept;

  UniqueFd socket_;
  std::int64_t due_ns_ = 0;
};

}  // namespace strainwave
