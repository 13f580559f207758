// SPDX-License-Identifier: BSD-3-Clause
// What loop_trap.cc counts on the real-time thread of a running daemon.
#pragma once

#include <atomic>
#include <cstdint>

namespace strainwave::testing {

struct LoopTrapCounts {
  std::atomic<std::int64_t> loaded;       ///< 1: the library is in the process
  std::atomic<std::int64_t> allocations;  ///< of heap memory, and releases
  std::atomic<std::int64_t> locks;        ///< mutexes, read-write locks and waits, contended or not
};

}  // namespace strainwave::testing
