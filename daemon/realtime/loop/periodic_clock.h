// SPDX-License-Identifier: BSD-3-Clause
// The period: absolute sleeps on CLOCK_MONOTONIC. The only place of the real-time thread that reads a clock. Real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

/// CLOCK_MONOTONIC now.
std::int64_t monotonic_now_ns() noexcept;

/// Keeps the processor busy for `duration_ns`; only injected faults want that.
void busy_wait(std::int64_t duration_ns) noexcept;

class PeriodicClock {
 public:
  struct Wake {
    std::int64_t due_ns = 0;   ///< when it was to wake up
    std::int64_t woke_ns = 0;  ///< when it did
    std::int64_t instant_ns =
        0;  ///< which of the periods' instants this cycle stands for: the one nearest to woke_ns
    std::int64_t skipped =
        0;  ///< periods left out: the cycle before ran past their start, or the wake-up came too late
  };

  explicit PeriodicClock(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  /// The first cycle begins one period from now.
  void start() noexcept { next_ns_ = monotonic_now_ns() + period_ns_; }

  /// Sleeps until the next cycle begins. A cycle that is already over is skipped, never squeezed in. Instants are whole periods
  /// apart; the next cycle says how many were skipped before it, whatever the cause.
  Wake wait() noexcept;

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace strainwave
