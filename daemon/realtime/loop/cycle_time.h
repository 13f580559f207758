// SPDX-License-Identifier: BSD-3-Clause
// When a period happens. Plain data, real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

struct CycleTime {
  std::int64_t now_ns = 0;           ///< CLOCK_MONOTONIC: the instant that this period stands for
  std::int64_t cycle = 0;            ///< periods since the loop began, those left out included
  std::int64_t elapsed_periods = 1;  ///< since the period before; more where the loop has left some out
};

}  // namespace strainwave
