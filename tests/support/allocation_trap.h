// SPDX-License-Identifier: BSD-3-Clause
// Counts what one thread allocates and frees on the heap, to show that real-time code does neither. For tests.
//
// Linking this file's target replaces malloc and its relatives in the whole program. The replacements count,
// and then call the C library; operator new ends there too. A sanitizer has its own malloc, with which
// nothing is counted. Tests therefore ask available() and skip.
//
//   AllocationTrap trap;
//   loop.step(time);
//   EXPECT_EQ(trap.touches(), 0);
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace strainwave {

class AllocationTrap {
 public:
  /// Counts for the calling thread from now on, or for the thread with kernel id `thread`. One trap at a time.
  AllocationTrap() noexcept;
  explicit AllocationTrap(pid_t thread) noexcept;
  ~AllocationTrap();
  AllocationTrap(const AllocationTrap&) = delete;
  AllocationTrap& operator=(const AllocationTrap&) = delete;

  static bool available() noexcept;

  std::int64_t allocations() const noexcept;
  std::int64_t frees() const noexcept;  ///< except of null
  std::int64_t touches() const noexcept { return allocations() + frees(); }
};

}  // namespace strainwave
