// SPDX-License-Identifier: BSD-3-Clause
// A histogram of durations with the buckets of lcmtypes/timing_buckets.h, written by one thread and read by others. Real-time safe.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "lcmtypes/timing_buckets.h"

namespace strainwave {

using HistogramCounts = std::array<std::int64_t, kHistogramBuckets>;

class Histogram {
 public:
  Histogram() noexcept {
    for (std::size_t i = 0; i < kHistogramBuckets; ++i)
      upper_ns_[i] = static_cast<std::int64_t>(bucket_upper_ns(i));
  }

  /// Counts one duration; negative ones count as 0. One thread only.
  void add(std::int64_t duration_ns) noexcept {
    const auto above = std::upper_bound(upper_ns_.begin(), upper_ns_.end() - 1, duration_ns);
    std::atomic<std::int64_t>& count = counts_[static_cast<std::size_t>(above - upper_ns_.begin())];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (duration_ns > max_ns_.load(std::memory_order_relaxed))
      max_ns_.store(duration_ns, std::memory_order_relaxed);
  }

  /// A copy for another thread; counts added meanwhile may or may not be in it.
  HistogramCounts counts() const noexcept {
    HistogramCounts copy{};
    for (std::size_t i = 0; i < kHistogramBuckets; ++i) copy[i] = counts_[i].load(std::memory_order_relaxed);
    return copy;
  }
  std::int64_t max_ns() const noexcept { return max_ns_.load(std::memory_order_relaxed); }

 private:
  std::array<std::int64_t, kHistogramBuckets> upper_ns_{};
  std::array<std::atomic<std::int64_t>, kHistogramBuckets> counts_{};
  std::atomic<std::int64_t> max_ns_{0};
};

}  // namespace strainwave
