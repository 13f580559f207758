// SPDX-License-Identifier: BSD-3-Clause
// The buckets of timing_v1's histograms. Bucket i counts values below bucket_upper_ns(i) = 1000 * 2^(i/4) ns and not below the bound
// of bucket i-1; the last takes the rest. 64 buckets reach from 1 us to 55 ms at 19 % resolution. Real-time safe.
#pragma once

#include <cmath>
#include <cstddef>

namespace strainwave {

inline constexpr std::size_t kHistogramBuckets = 64;

inline double bucket_upper_ns(std::size_t bucket) {
  return 1000.0 * std::exp2(static_cast<double>(bucket) / 4.0);
}

}  // namespace strainwave
