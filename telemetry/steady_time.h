// SPDX-License-Identifier: BSD-3-Clause
// The monotonic clock of the process. Not real-time.
#pragma once

#include <chrono>

namespace strainwave {

inline double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace strainwave
