// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/clock.h"

#include <algorithm>

namespace strainwave {

namespace {
// Longer waits mean "for ever"; a year keeps the arithmetic of the clock far from overflow.
constexpr double kLongestWait_s = 365.0 * 24.0 * 3600.0;
}  // namespace

Instant now() noexcept {
  return std::chrono::steady_clock::now();
}

double seconds_between(Instant earlier, Instant later) noexcept {
  return std::chrono::duration<double>(later - earlier).count();
}

Deadline::Deadline(double seconds)
    : end_(now() + std::chrono::duration_cast<Instant::duration>(
                       std::chrono::duration<double>(std::clamp(seconds, 0.0, kLongestWait_s)))) {}

bool Deadline::passed() const noexcept {
  return now() >= end_;
}

int Deadline::remaining_ms() const noexcept {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end_ - now()).count();
  // One wait is at most a minute: callers loop until the deadline has passed.
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

}  // namespace strainwave
