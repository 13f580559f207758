// SPDX-License-Identifier: BSD-3-Clause
// Tracks which of a joint's table slots are in use: the supervisor's side of a live table swap. Not real-time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "daemon/realtime/joint/joint_loop.h"

namespace strainwave {

class TableBook {
 public:
  /// A slot that the loop neither uses nor may return to, or nothing while a swap is under way.
  std::optional<std::size_t> free_slot() const {
    if (pending_) return std::nullopt;
    for (std::size_t slot = 0; slot < JointLoop::kTableSlots; ++slot)
      if (slot != active_ && slot != previous_) return slot;
    return std::nullopt;
  }
  /// The table before the active one, or nothing.
  std::optional<std::size_t> previous_slot() const { return previous_; }
  bool busy() const { return pending_.has_value(); }

  /// An order to use `slot` is on its way.
  void begin(std::size_t slot) { pending_ = slot; }
  /// The loop answered it.
  void end(bool accepted) {
    if (accepted && pending_) {
      previous_ = active_;
      active_ = pending_;
    }
    pending_.reset();
  }

 private:
  std::optional<std::size_t> active_;
  std::optional<std::size_t> previous_;
  std::optional<std::size_t> pending_;
};

}  // namespace strainwave
