// SPDX-License-Identifier: BSD-3-Clause
// A ring that one thread writes and any process may read through shared memory. The writer never waits and never looks
// at a reader: a reader that falls behind loses records and knows how many. Real-time safe for the writer.
//
// Each slot is a sequence lock; the payload moves as atomic words, so that a torn read is detected and is no data race.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace strainwave {

template <typename T, std::size_t Capacity>
class BroadcastRing {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "shared between processes");
  static constexpr std::size_t kWords = sizeof(T) / sizeof(std::uint64_t);

 public:
  /// Writer, one thread only.
  void write(const T& record) noexcept {
    const std::uint64_t index = written_.load(std::memory_order_relaxed);
    Slot& slot = slots_[index % Capacity];
    std::array<std::uint64_t, kWords> words;
    std::memcpy(words.data(), &record, sizeof(T));
    slot.version.store(2 * index + 1, std::memory_order_relaxed);  // odd: being written
    for (std::size_t i = 0; i < kWords; ++i) slot.words[i].store(words[i], std::memory_order_release);
    slot.version.store(2 * index + 2, std::memory_order_release);
    written_.store(index + 1, std::memory_order_release);
  }

  /// Reader: the next record after `cursor`, which advances. Records that were overwritten before they could be read
  /// are added to `dropped`. False when there is nothing new.
  bool read(std::uint64_t& cursor, T& record, std::uint64_t& dropped) const noexcept {
    for (;;) {
      const std::uint64_t written = written_.load(std::memory_order_acquire);
      if (cursor >= written) return false;
      if (written - cursor > Capacity) {
        dropped += written - Capacity - cursor;
        cursor = written - Capacity;
      }
      const bool whole = try_read(cursor, record);
      ++cursor;
      if (whole) return true;
      ++dropped;
    }
  }

  /// Records written so far.
  std::uint64_t written() const noexcept { return written_.load(std::memory_order_acquire); }

 private:
  struct Slot {
    std::atomic<std::uint64_t> version{0};
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };

  bool try_read(std::uint64_t index, T& record) const noexcept {
    const Slot& slot = slots_[index % Capacity];
    const std::uint64_t wanted = 2 * index + 2;
    if (slot.version.load(std::memory_order_acquire) != wanted) return false;
    std::array<std::uint64_t, kWords> words;
    for (std::size_t i = 0; i < kWords; ++i) words[i] = slot.words[i].load(std::memory_order_acquire);
    if (slot.version.load(std::memory_order_relaxed) != wanted) return false;
    std::memcpy(static_cast<void*>(&record), words.data(), sizeof(T));
    return true;
  }

  alignas(64) std::atomic<std::uint64_t> written_{0};
  std::array<Slot, Capacity> slots_{};
};

}  // namespace strainwave
