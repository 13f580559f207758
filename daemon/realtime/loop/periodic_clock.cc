// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/periodic_clock.h"

#include <cerrno>
#include <ctime>

#include "base/durations.h"

namespace strainwave {

std::int64_t monotonic_now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return nanoseconds(now);
}

void busy_wait(std::int64_t duration_ns) noexcept {
  const std::int64_t until_ns = monotonic_now_ns() + duration_ns;
  while (monotonic_now_ns() < until_ns) {
  }
}

PeriodicClock::Wake PeriodicClock::wait() noexcept {
  Wake wake;
  const std::int64_t late_ns = monotonic_now_ns() - next_ns_;
  if (late_ns > 0) {
    wake.skipped = (late_ns + period_ns_ - 1) / period_ns_;
    next_ns_ += wake.skipped * period_ns_;
  }
  const timespec until = to_timespec(next_ns_);
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  wake.due_ns = next_ns_;
  wake.woke_ns = monotonic_now_ns();
  const std::int64_t overslept = (wake.woke_ns - wake.due_ns + period_ns_ / 2) / period_ns_;
  wake.skipped += overslept;
  wake.instant_ns = wake.due_ns + overslept * period_ns_;
  next_ns_ = wake.instant_ns + period_ns_;
  return wake;
}

}  // namespace strainwave
