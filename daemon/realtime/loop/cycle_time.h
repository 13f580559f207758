// SPDX-License-Identifier: BSD-3-Clause
// The time of a period. Plain data, real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

struct CycleTime {
  std::int64_t now_ns = 0;           ///< CLOCK_MONOTONIC: the instant that this period stands for
  std::int64_t cycle = 0;            ///< periods since the loop began, including skipped ones
  std::int64_t elapsed_periods = 1;  ///< since the previous cycle; above 1 after skipped periods
};

}  // namespace strainwave
