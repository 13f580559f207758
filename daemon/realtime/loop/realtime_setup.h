// SPDX-License-Identifier: BSD-3-Clause
// Requests from Linux what a real-time loop needs. Not real-time itself: called before the first period.
#pragma once

#include <string>

#include "base/unique_fd.h"

namespace strainwave {

/// Locks all memory, present and future, switches transparent huge pages off, and has malloc keep freed memory. Empty when granted, else
/// what was refused and what to do.
std::string lock_memory();

/// Advice if the kernel moves locked pages to make room for large ones. Empty if it does not, or if the setting cannot be read
/// (the unit hides /proc/sys).
std::string compaction_warning(const std::string& setting_path = "/proc/sys/vm/compact_unevictable_allowed");

/// Makes the calling thread SCHED_FIFO with `priority`, pinned to `cpu` unless negative, and touches its stack. Empty
/// when granted, else what was refused and what to do.
std::string make_thread_real_time(int priority, int cpu);

/// Why no thread of this process may run on `cpu`, and what to do; empty when one may, or `cpu` is negative. Tests it in a temporary
/// thread, so that nothing changes.
std::string processor_problem(int cpu);

/// Keeps the processors out of deep sleep states while the descriptor stays open: their exit times would add latency to every period.
/// `refusal` is empty when granted, else why not and what to do. It is also empty on a machine without that file, such as a virtual one.
UniqueFd avoid_sleep_states(std::string& refusal, const std::string& file = "/dev/cpu_dma_latency");

/// Page faults of the calling thread so far, minor and major. Real-time safe.
long thread_page_faults() noexcept;

}  // namespace strainwave
