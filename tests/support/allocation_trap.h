// SPDX-License-Identifier: BSD-3-Clause
// Counts what one thread allocates and frees on the heap: proof that real-time code does neither. For tests.
//
// Linking this file's target replaces malloc and its relatives in the whole program by ones that count and
// then do what the C library does; operator new ends there too. Under a sanitizer, which has its own, nothing
// is counted: ask available() and skip the test.
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
  std::int64_t frees() const noexcept;  ///< of null not counted
  std::int64_t touches() const noexcept { return allocations() + frees(); }
};

}  // namespace strainwave
