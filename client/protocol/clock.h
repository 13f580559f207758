// SPDX-License-Identifier: BSD-3-Clause
// The client's monotonic clock. Not real-time.
#pragma once

#include <chrono>

namespace strainwave {

/// A time of the monotonic clock, the only clock for ages and time-outs.
using Instant = std::chrono::steady_clock::time_point;

Instant now() noexcept;

/// Seconds from `earlier` to `later`.
double seconds_between(Instant earlier, Instant later) noexcept;

/// The end of a wait.
class Deadline {
 public:
  explicit Deadline(double seconds);
  bool passed() const noexcept;
  /// Milliseconds left, rounded up so that waiting this long reaches the deadline; 0 when it has passed.
  int remaining_ms() const noexcept;

 private:
  Instant end_;
};

}  // namespace strainwave
