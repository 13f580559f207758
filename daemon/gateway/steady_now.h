// SPDX-License-Identifier: BSD-3-Clause
// The clock of the gateway's process, which shares no code with the loop's. Not real-time.
#pragma once

#include <chrono>
#include <cstdint>

namespace strainwave {

/// Monotonic, ns.
inline std::int64_t steady_now_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace strainwave
