// SPDX-License-Identifier: BSD-3-Clause
// Durations in whole nanoseconds, the loop's unit of time. Real-time safe.
#pragma once

#include <cmath>
#include <cstdint>
#include <ctime>

namespace strainwave {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// Seconds in nanoseconds, rounded to the nearest. |duration_s| up to 9e9.
inline std::int64_t nanoseconds(double duration_s) noexcept {
  return std::llround(duration_s * static_cast<double>(kNanosecondsPerSecond));
}

constexpr std::int64_t nanoseconds(const std::timespec& time) noexcept {
  return time.tv_sec * kNanosecondsPerSecond + time.tv_nsec;
}

/// Nanoseconds in seconds.
constexpr double seconds(std::int64_t duration_ns) noexcept {
  return static_cast<double>(duration_ns) / static_cast<double>(kNanosecondsPerSecond);
}

/// For system calls; `duration_ns` >= 0.
constexpr std::timespec to_timespec(std::int64_t duration_ns) noexcept {
  return {duration_ns / kNanosecondsPerSecond, duration_ns % kNanosecondsPerSecond};
}

}  // namespace strainwave
