// SPDX-License-Identifier: BSD-3-Clause
// How much of its periods a loop may miss. A few are noise of the machine; many in a row, a long stall, or many in a second, and
// the loop no longer controls. Real-time safe.
//
//   late cycles in a row >= in_a_row                         -> kOverruns
//   one stall, from the period before to this one > stall_s  -> kLoopStalled
//   periods missed in the last second > missed_share of it   -> kPeriodsMissed
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "strainwave/vocabulary.h"

namespace strainwave {

struct OverrunLimits {
  int in_a_row = 10;          ///< cycles that begin a period or more late
  double stall_s = 0.02;      ///< > 0
  double missed_share = 0.1;  ///< of a second's periods, in [0, 1]; 1: never
};

class OverrunWatch {
 public:
  OverrunWatch(const OverrunLimits& limits, double period_s) noexcept;

  /// One cycle that began after `skipped` periods were left out. The fault that this makes, or kNone; what was counted towards it
  /// is then forgotten.
  Fault judge(std::int64_t skipped) noexcept;

 private:
  void count(std::int64_t skipped) noexcept;
  std::int64_t missed() const noexcept;

  // The last second in slots, each with the periods missed in it.
  static constexpr std::size_t kSlots = 20;
  static constexpr double kWindow_s = 1.0;

  int in_a_row_limit_;
  std::int64_t stall_limit_periods_;
  std::int64_t missed_limit_periods_;
  std::int64_t slot_periods_;
  int in_a_row_ = 0;
  std::array<std::int64_t, kSlots> missed_{};
  std::size_t slot_ = 0;
  std::int64_t in_slot_periods_ = 0;
};

}  // namespace strainwave
