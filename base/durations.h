// Durations as the loop counts time. Real-time safe.
#pragma once

#include <cmath>
#include <cstdint>

namespace strainwave {

/// Seconds in nanoseconds, rounded to the nearest. |duration_s| up to 9e9.
inline std::int64_t nanoseconds(double duration_s) noexcept {
  return std::llround(duration_s * 1e9);
}

}  // namespace strainwave
