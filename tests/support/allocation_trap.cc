// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/allocation_trap.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include "tests/support/c_library_allocator.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STRAINWAVE_TRAP_AVAILABLE 0
#else
#define STRAINWAVE_TRAP_AVAILABLE 1
#endif

namespace {

std::atomic<pid_t> trapped_thread{0};  // 0: none
std::atomic<std::int64_t> allocation_count{0};
std::atomic<std::int64_t> free_count{0};

}  // namespace

#if STRAINWAVE_TRAP_AVAILABLE

namespace {

// The system call happens only while a trap is set, so that programs otherwise run at their usual speed.
void count_into(std::atomic<std::int64_t>& counter) noexcept {
  const pid_t trapped = trapped_thread.load(std::memory_order_relaxed);
  if (trapped != 0 && ::gettid() == trapped) counter.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  count_into(allocation_count);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  count_into(allocation_count);
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  count_into(allocation_count);
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  count_into(allocation_count);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_into(allocation_count);
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  count_into(allocation_count);
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
  void* const made = __libc_memalign(alignment, size);
  if (made == nullptr) return ENOMEM;
  *block = made;
  return 0;
}

void free(void* block) {
  if (block != nullptr) count_into(free_count);
  __libc_free(block);
}

}  // extern "C"

#endif

namespace strainwave {

AllocationTrap::AllocationTrap() noexcept : AllocationTrap(::gettid()) {}

AllocationTrap::AllocationTrap(pid_t thread) noexcept {
  allocation_count.store(0, std::memory_order_relaxed);
  free_count.store(0, std::memory_order_relaxed);
  trapped_thread.store(thread, std::memory_order_relaxed);
}

AllocationTrap::~AllocationTrap() {
  trapped_thread.store(0, std::memory_order_relaxed);
}

bool AllocationTrap::available() noexcept {
  return STRAINWAVE_TRAP_AVAILABLE != 0;
}

std::int64_t AllocationTrap::allocations() const noexcept {
  return allocation_count.load(std::memory_order_relaxed);
}

std::int64_t AllocationTrap::frees() const noexcept {
  return free_count.load(std::memory_order_relaxed);
}

}  // namespace strainwave
