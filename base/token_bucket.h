// SPDX-License-Identifier: BSD-3-Clause
// Rate limit of events: `per_second` on average, `burst` at once.
//
//   left(t) = min(burst, left(t0) + (t - t0) per_second)        begins full; each event takes 1
//
// Time is an argument and may stand still; time that goes back counts as standing still. Bounded memory, no clock.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/durations.h"

namespace strainwave {

class TokenBucket {
 public:
  /// `per_second` > 0, `burst` >= 1.
  TokenBucket(double per_second, double burst) noexcept
      : per_second_(per_second), burst_(burst), left_(burst) {}

  /// Events that are allowed at `now_ns`, up to `burst`; below 1 none is.
  double left(std::int64_t now_ns) noexcept {
    if (now_ns > filled_ns_) {
      left_ = std::min(burst_, left_ + seconds(now_ns - filled_ns_) * per_second_);
      filled_ns_ = now_ns;
    }
    return left_;
  }
  /// Takes 1. left() must have returned at least 1.
  void take() noexcept { left_ -= 1.0; }
  bool try_take(std::int64_t now_ns) noexcept {
    if (left(now_ns) < 1.0) return false;
    take();
    return true;
  }

  double burst() const noexcept { return burst_; }

 private:
  double per_second_;
  double burst_;
  double left_;
  std::int64_t filled_ns_ = 0;
};

}  // namespace strainwave
