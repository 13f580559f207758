// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/histogram.h"

#include <gtest/gtest.h>

#include <thread>

namespace strainwave {
namespace {

TEST(Histogram, PutsEachDurationBelowItsBucketsBoundAndNotBelowTheOneBefore) {
  for (const std::int64_t duration_ns :
       {0L, 999L, 1000L, 1189L, 1190L, 5000L, 123456L, 1000000L, 40000000L}) {
    Histogram histogram;
    histogram.add(duration_ns);
    const HistogramCounts counts = histogram.counts();
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      EXPECT_LT(static_cast<double>(duration_ns), bucket_upper_ns(i));
      if (i > 0) {
        EXPECT_GE(static_cast<double>(duration_ns), std::floor(bucket_upper_ns(i - 1)));
      }
    }
  }
}

TEST(Histogram, KeepsTheMaximumAndCountsWhatIsBeyondTheLastBucket) {
  Histogram histogram;
  histogram.add(10'000'000'000);
  histogram.add(-5);
  EXPECT_EQ(histogram.max_ns(), 10'000'000'000);
  EXPECT_EQ(histogram.counts().back(), 1);
  EXPECT_EQ(histogram.counts().front(), 1);
}

TEST(Histogram, CanBeReadWhileItIsWritten) {
  Histogram histogram;
  std::thread writer([&] {
    for (int i = 0; i < 100'000; ++i) histogram.add(i % 100'000);
  });
  std::int64_t total = 0;
  while (total < 100'000) {
    const HistogramCounts counts = histogram.counts();
    std::int64_t sum = 0;
    for (const std::int64_t count : counts) sum += count;
    ASSERT_GE(sum, total);
    total = sum;
    std::this_thread::yield();
  }
  writer.join();
}

}  // namespace
}  // namespace strainwave
