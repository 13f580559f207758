// SPDX-License-Identifier: BSD-3-Clause
// How the gateway wakes the core. A pipe, because its two ends are separate open files: whatever the gateway does to its own
// end, reading the other one never waits. (An eventfd is one file for both: who clears its O_NONBLOCK stops its reader.)
// Not real-time.
#pragma once

namespace strainwave {

class WakePipe {
 public:
  /// Throws std::system_error.
  WakePipe();
  ~WakePipe();
  WakePipe(const WakePipe&) = delete;
  WakePipe& operator=(const WakePipe&) = delete;

  /// The core's end, readable while a wake waits.
  int core_end() const noexcept { return core_end_; }
  /// The end for the gateway to inherit: one byte is one wake.
  int gateway_end() const noexcept { return gateway_end_; }
  /// Takes the wakes that wait, in one bounded read, however much is written meanwhile.
  void take() noexcept;

 private:
  int core_end_ = -1;
  int gateway_end_ = -1;
};

}  // namespace strainwave
