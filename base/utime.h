// SPDX-License-Identifier: BSD-3-Clause
// The wall clock as messages carry it: microseconds since the epoch, for records only. Not real-time.
#pragma once

#include <chrono>
#include <cstdint>

namespace strainwave {

inline std::int64_t utime_now() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace strainwave
