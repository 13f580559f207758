// When a period happens. Plain data, real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

struct CycleTime {
  std::int64_t now_ns = 0;  ///< CLOCK_MONOTONIC when the period began
  std::int64_t cycle = 0;   ///< periods since the loop began, those left out included
};

}  // namespace strainwave
