// SPDX-License-Identifier: BSD-3-Clause
// Hands a path from the supervisor's thread to a joint's loop, through two slots. The loop uses at most one of them while the
// supervisor fills the other. The loop's side is real-time safe.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "control/trajectory/knot_path.h"

namespace strainwave {

/// One joint's part of a path.
struct LoadedPath {
  std::int64_t id = 0;           ///< of the path, the same for all of its joints
  std::int32_t joint_count = 0;  ///< number of joints of the path
  KnotPath path;
};

class PathSlots {
 public:
  // Supervisor's thread.
  /// Copies `path` into a slot and returns its number for the order. Nothing while the loop has not judged the previous path.
  std::optional<std::int32_t> hand_over(const LoadedPath& path) {
    if (handed_ != judged_.load(std::memory_order_acquire)) return std::nullopt;
    const std::int32_t slot = used_.load(std::memory_order_acquire) == 0 ? 1 : 0;
    slots_[static_cast<std::size_t>(slot)] = path;
    ++handed_;
    return slot;
  }
  /// Undoes hand_over(), because the order could not be queued.
  void take_back() { --handed_; }

  // Real-time thread.
  const LoadedPath& at(std::int32_t slot) const noexcept { return slots_[static_cast<std::size_t>(slot)]; }
  /// The slot stays in use until the next use() or drop().
  void use(std::int32_t slot) noexcept { used_.store(slot, std::memory_order_release); }
  void drop() noexcept { used_.store(kNone, std::memory_order_release); }
  /// The order was obeyed, after use(), or refused.
  void judged() noexcept {
    judged_.store(judged_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  static constexpr std::int32_t kNone = -1;
  std::array<LoadedPath, 2> slots_{};
  std::int64_t handed_ = 0;
  std::atomic<std::int64_t> judged_{0};
  std::atomic<std::int32_t> used_{kNone};
};

}  // namespace strainwave
