// SPDX-License-Identifier: BSD-3-Clause
// A bounded queue between one writing and one reading thread. Wait-free on both sides, real-time safe: a full queue
// refuses, it never blocks.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

namespace strainwave {

template <typename T, std::size_t Capacity>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert((Capacity & (Capacity - 1)) == 0, "a power of two");

 public:
  /// Writer: false when the queue is full.
  bool push(const T& item) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == Capacity) return false;
    items_[head % Capacity] = item;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Writer: how many more can be pushed, at least.
  std::size_t room() const noexcept {
    return Capacity - (head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire));
  }

  /// Reader: false when the queue is empty.
  bool pop(T& item) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    item = items_[tail % Capacity];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<T, Capacity> items_{};
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace strainwave
