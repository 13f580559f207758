// SPDX-License-Identifier: BSD-3-Clause
// Counts of loop_trap.cc for the real-time thread of a running daemon.
#pragma once

#include <atomic>
#include <cstdint>

namespace strainwave::testing {

struct LoopTrapCounts {
  std::atomic<std::int64_t> loaded;       ///< 1: the library is in the process
  std::atomic<std::int64_t> allocations;  ///< allocations and releases of heap memory
  std::atomic<std::int64_t> locks;        ///< mutexes, read-write locks and waits, contended or not
};

}  // namespace strainwave::testing
