// SPDX-License-Identifier: BSD-3-Clause
// Generates the periods by absolute sleeps on CLOCK_MONOTONIC. The loop reads no other clock. Real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

/// CLOCK_MONOTONIC now.
std::int64_t monotonic_now_ns() noexcept;

/// Keeps the processor busy for `duration_ns`; only injected faults use it.
void busy_wait(std::int64_t duration_ns) noexcept;

class PeriodicClock {
 public:
  struct Wake {
    std::int64_t due_ns = 0;      ///< when it should wake up
    std::int64_t woke_ns = 0;     ///< when it did
    std::int64_t instant_ns = 0;  ///< start of the period nearest to woke_ns: the cycle stands for it
    std::int64_t skipped = 0;     ///< periods left out, because the previous cycle or the wake-up was late
  };

  explicit PeriodicClock(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  /// The first cycle begins one period from now.
  void start() noexcept { next_ns_ = monotonic_now_ns() + period_ns_; }

  /// Sleeps until the next cycle begins. Missed cycles are skipped, never caught up. Instants are whole periods apart; `skipped`
  /// counts all periods missed before this cycle.
  Wake wait() noexcept;

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace strainwave
