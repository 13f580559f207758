// SPDX-License-Identifier: BSD-3-Clause
// Loaded into strainwaved before its own libraries (LD_PRELOAD): counts in the running daemon what the
// real-time thread must never do. It recognises that thread by its SCHED_FIFO policy. The counts are in the
// mapped file $STRAINWAVE_LOOP_TRAP, so that a test reads them while the daemon runs.
#include "tests/support/loop_trap.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/support/c_library_allocator.h"

namespace {

using strainwave::testing::LoopTrapCounts;

LoopTrapCounts* counts = nullptr;

bool in_loop() noexcept {
  return counts != nullptr && ::sched_getscheduler(0) == SCHED_FIFO;
}

void note_allocation() noexcept {
  if (in_loop()) counts->allocations.fetch_add(1, std::memory_order_relaxed);
}

void note_lock() noexcept {
  if (in_loop()) counts->locks.fetch_add(1, std::memory_order_relaxed);
}

template <typename Function>
Function* next(const char* name) noexcept {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

__attribute__((constructor)) void open_counts() {
  const char* path = std::getenv("STRAINWAVE_LOOP_TRAP");  // NOLINT(concurrency-mt-unsafe): before any thread
  if (path == nullptr) return;
  ::unsetenv("LD_PRELOAD");  // not in the gateway, whose filter forbids the system calls made here
  const int file = ::open(path, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  void* memory = ::mmap(nullptr, sizeof(LoopTrapCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory != MAP_FAILED) counts = static_cast<LoopTrapCounts*>(memory);
  if (counts != nullptr) counts->loaded.store(1);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  note_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  note_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  note_allocation();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note_allocation();
  return __libc_memalign(alignment, size);
}
void free(void* block) {
  if (block != nullptr) note_allocation();
  __libc_free(block);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static auto* const real = next<int(pthread_mutex_t*)>("pthread_mutex_lock");
  note_lock();
  return real(mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) {
  static auto* const real = next<int(pthread_mutex_t*)>("pthread_mutex_trylock");
  note_lock();
  return real(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
  static auto* const real = next<int(pthread_rwlock_t*)>("pthread_rwlock_rdlock");
  note_lock();
  return real(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
  static auto* const real = next<int(pthread_rwlock_t*)>("pthread_rwlock_wrlock");
  note_lock();
  return real(lock);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static auto* const real = next<int(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait");
  note_lock();
  return real(condition, mutex);
}

}  // extern "C"
