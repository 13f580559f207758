// SPDX-License-Identifier: BSD-3-Clause
// Wakes the core from the gateway. A pipe has two separate open files at its ends: whatever the gateway does to its own end,
// reading the other one never waits. (An eventfd is one file for both: clearing O_NONBLOCK in the gateway would block the core.)
// Not real-time.
#pragma once

#include "base/unique_fd.h"

namespace strainwave {

class WakePipe {
 public:
  /// Throws std::system_error.
  WakePipe();

  /// The core's end, readable while a wake waits.
  int core_end() const noexcept { return core_end_.get(); }
  /// The end for the gateway to inherit: one byte is one wake.
  int gateway_end() const noexcept { return gateway_end_.get(); }
  /// Takes the waiting wakes in one bounded read, however much is written meanwhile.
  void take() noexcept;

 private:
  UniqueFd core_end_;
  UniqueFd gateway_end_;
};

}  // namespace strainwave
