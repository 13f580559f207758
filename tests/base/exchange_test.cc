// SPDX-License-Identifier: BSD-3-Clause
// Data exchange between threads under contention: it keeps the order, counts losses and tears no value.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <thread>

#include "base/broadcast_ring.h"
#include "base/spsc_queue.h"

namespace strainwave {
namespace {

struct Record {
  std::array<std::uint64_t, 32> words;
};

Record filled(std::uint64_t value) {
  Record record;
  record.words.fill(value);
  return record;
}

TEST(SpscQueue, KeepsOrderAndLosesNothingThatItAccepted) {
  constexpr std::uint64_t kItems = 200'000;
  auto queue = std::make_unique<SpscQueue<std::uint64_t, 64>>();
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kItems;)
      if (queue->push(i))
        ++i;
      else
        std::this_thread::yield();
  });
  std::uint64_t expected = 0;
  while (expected < kItems) {
    std::uint64_t item = 0;
    if (!queue->pop(item)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(item, expected);
    ++expected;
  }
  writer.join();
}

TEST(SpscQueue, RefusesWhenFullAndTakesAgainAfterAPop) {
  SpscQueue<int, 4> queue;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_FALSE(queue.push(4));
  int item = -1;
  EXPECT_TRUE(queue.pop(item));
  EXPECT_EQ(item, 0);
  EXPECT_TRUE(queue.push(4));
}

TEST(BroadcastRing, GivesWholeRecordsInOrderAndCountsExactlyWhatWasLost) {
  constexpr std::uint64_t kRecords = 100'000;
  auto ring = std::make_unique<BroadcastRing<Record, 16>>();
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kRecords; ++i) {
      ring->write(filled(i));
      if (i % 64 == 0) std::this_thread::yield();
    }
    done.store(true, std::memory_order_release);
  });
  std::uint64_t cursor = 0;
  std::uint64_t dropped = 0;
  std::uint64_t read = 0;
  std::int64_t last = -1;
  for (;;) {
    const bool finished = done.load(std::memory_order_acquire);
    Record record{};
    while (ring->read(cursor, record, dropped)) {
      for (const std::uint64_t word : record.words) ASSERT_EQ(word, record.words[0]) << "torn";
      ASSERT_GT(static_cast<std::int64_t>(record.words[0]), last);
      last = static_cast<std::int64_t>(record.words[0]);
      ++read;
    }
    if (finished) break;
  }
  writer.join();
  EXPECT_EQ(read + dropped, kRecords);
  EXPECT_EQ(last, static_cast<std::int64_t>(kRecords) - 1);
}

TEST(BroadcastRing, TheWriterDoesNotNoticeReadersThatNeverRead) {
  auto ring = std::make_unique<BroadcastRing<Record, 16>>();
  for (std::uint64_t i = 0; i < 100; ++i) ring->write(filled(i));
  std::uint64_t cursor = 0;
  std::uint64_t dropped = 0;
  Record record{};
  ASSERT_TRUE(ring->read(cursor, record, dropped));
  EXPECT_EQ(record.words[0], 84U);
  EXPECT_EQ(dropped, 84U);
}

}  // namespace
}  // namespace strainwave
