// SPDX-License-Identifier: BSD-3-Clause
// Supervises the periods that the loop misses. A few are noise of the machine. After a long stall, or with many misses in a second,
// the joints are no longer under control. Real-time safe.
//
//   one stall, from the period before to this one > stall_s     -> kLoopStalled
//   missed > missed_share * second                              -> kPeriodsMissed
//
// All in periods. The count of missed periods decays within about a second:
//
//   missed := missed * (1 - elapsed / second) + skipped         a loop that always misses a share s arrives at s * second
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "strainwave/vocabulary.h"

namespace strainwave {

struct OverrunLimits {
  double stall_s = 0.02;      ///< > 0
  double missed_share = 0.1;  ///< share of a second's periods, in [0, 1]; 1: no fault
};

class OverrunWatch {
 public:
  OverrunWatch(const OverrunLimits& limits, double period_s) noexcept
      : second_periods_(1.0 / period_s),
        stall_limit_periods_(std::max(1.0, std::round(limits.stall_s / period_s))),
        missed_limit_periods_(limits.missed_share * second_periods_) {}

  /// Counts a cycle that began after `skipped` periods were left out. Returns the resulting fault, or kNone. A fault resets the
  /// count.
  Fault judge(std::int64_t skipped) noexcept {
    const auto left_out = static_cast<double>(skipped);
    const double kept = std::max(0.0, 1.0 - (1.0 + left_out) / second_periods_);
    missed_periods_ = kept * missed_periods_ + std::min(left_out, second_periods_);
    const bool stalled = skipped > 0 && 1.0 + left_out > stall_limit_periods_;
    if (!stalled && missed_periods_ <= missed_limit_periods_) return Fault::kNone;
    missed_periods_ = 0.0;
    return stalled ? Fault::kLoopStalled : Fault::kPeriodsMissed;
  }

 private:
  double second_periods_;
  double stall_limit_periods_;
  double missed_limit_periods_;
  double missed_periods_ = 0.0;
};

}  // namespace strainwave
