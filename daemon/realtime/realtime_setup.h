// What Linux must grant before a loop can be real-time. Not real-time itself: called before the first period.
#pragma once

#include <string>

namespace strainwave {

/// Locks all memory, present and future, does without transparent huge pages, and tells malloc to keep it. Empty when granted, else what was refused and
/// what to do.
std::string lock_memory();

/// What to do about a kernel that moves locked pages to make room for large ones; empty when it does not, or does not say
/// (the unit hides /proc/sys).
std::string compaction_warning(const std::string& setting_path = "/proc/sys/vm/compact_unevictable_allowed");

/// Makes the calling thread SCHED_FIFO with `priority`, pinned to `cpu` unless negative, and touches its stack. Empty
/// when granted, else what was refused and what to do.
std::string make_thread_real_time(int priority, int cpu);

/// Page faults of the calling thread so far, minor and major. Real-time safe.
long thread_page_faults() noexcept;

}  // namespace strainwave
